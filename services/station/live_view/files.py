"""What the live view loads once, served compressed: the library that draws, the robot and its shapes."""

from __future__ import annotations

import gzip
import hashlib
import logging
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response

from services.station.live_view.description import Description

log = logging.getLogger(__name__)

LIBRARY_VERSION = "0.180.0"
"""Of three.js; a part of the address, which assets/js/drawing/three.js names: browsers keep each version for good."""

LIBRARY_FILES = ("three.module.min.js", "three.core.min.js", "OrbitControls.js")

# It holds three.js as published, beside what is of no use here, and needs no other package. None that is better kept
# has its modules: k3d, meshcat, nicegui, pythreejs and viser bundle it into scripts of their own.
_PACKAGE = "ifc-console-viewer"
_FOLDER = "ifc_console_viewer/static/vendor"

_KEEP = "public, max-age=31536000, immutable"
_LEVEL = 6


@dataclass(frozen=True)
class _File:
    kind: str
    compressed: bytes


class Files:
    """The files by their addresses below /view/.

    Args:
        description: of what is seen.
    """

    def __init__(self, description: Description) -> None:
        digest = hashlib.sha256(description.words + description.shapes).hexdigest()[:12]
        self.description_address = f"/view/{digest}/description.json"
        """Where the browser finds the description; its shapes lie beside it."""
        self._files = {
            f"{digest}/description.json": _compressed("application/json", description.words),
            f"{digest}/shapes.bin": _compressed("application/octet-stream", description.shapes),
            **{f"three-{LIBRARY_VERSION}/{path.name}": _script(path) for path in library()},
        }

    @property
    def size(self) -> int:
        """Of all files together, as they are sent [byte]."""
        return sum(len(file.compressed) for file in self._files.values())

    async def serve(self, request: Request) -> Response:
        """Answer a browser."""
        file = self._files.get(request.path_params["path"])
        if file is None:
            return PlainTextResponse("There is no such file.", status_code=404)
        headers = {"Content-Encoding": "gzip", "Cache-Control": _KEEP}
        return Response(file.compressed, media_type=file.kind, headers=headers)


def library() -> tuple[Path, ...]:
    """The files of three.js as they are installed; none where they are not, and the log says so."""
    try:
        folder = Path(str(distribution(_PACKAGE).locate_file(_FOLDER)))
    except PackageNotFoundError:
        folder = Path()
    paths = tuple(folder / name for name in LIBRARY_FILES)
    if all(path.is_file() for path in paths):
        return paths
    log.warning("the page has no 3-D view: %s is not installed; deploy/setup installs it", _PACKAGE)
    return ()


def _script(path: Path) -> _File:
    return _compressed("text/javascript", path.read_bytes())


def _compressed(kind: str, content: bytes) -> _File:
    return _File(kind, gzip.compress(content, _LEVEL, mtime=0))
