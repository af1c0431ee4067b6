"""What the live view loads once, served compressed: the library that draws, the robot and its shapes."""

from __future__ import annotations

import hashlib
import logging
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from services.station.live_view.description import Description
from services.web.shelf import KEPT, File, Shelf, file

log = logging.getLogger(__name__)

ADDRESS = "/view"

LIBRARY_VERSION = "0.180.0"
"""Of three.js; a part of the address, which assets/js/drawing/three.js names: browsers keep each version for good."""

LIBRARY_FILES = ("three.module.min.js", "three.core.min.js", "OrbitControls.js")

# It holds three.js as published, beside what is of no use here, and needs no other package. None that is better kept
# has its modules: k3d, meshcat, nicegui, pythreejs and viser bundle it into scripts of their own.
_PACKAGE = "ifc-console-viewer"
_FOLDER = "ifc_console_viewer/static/vendor"


class Files(Shelf):
    """The files by their addresses below /view/.

    Args:
        description: of what is seen.

    Attributes:
        description_address: where the browser finds the description.
        shapes_address: where it finds the shapes, beside it.
        library_addresses: where it finds the library.
    """

    def __init__(self, description: Description) -> None:
        digest = hashlib.sha256(description.words + description.shapes).hexdigest()[:12]
        words, shapes = f"{digest}/description.json", f"{digest}/shapes.bin"
        scripts = {f"three-{LIBRARY_VERSION}/{path.name}": _script(path) for path in library()}
        self.description_address = f"{ADDRESS}/{words}"
        self.shapes_address = f"{ADDRESS}/{shapes}"
        self.library_addresses = tuple(f"{ADDRESS}/{name}" for name in scripts)
        described = {
            words: file("application/json", description.words),
            shapes: file("application/octet-stream", description.shapes),
        }
        super().__init__({**described, **scripts}, KEPT)


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


def _script(path: Path) -> File:
    return file("text/javascript", path.read_bytes())
