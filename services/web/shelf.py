"""Files that are held in memory and served compressed: a page of many small ones waits for none to be read."""

from __future__ import annotations

import gzip
import hashlib
from collections.abc import Mapping
from dataclasses import dataclass

from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response

KEPT = "private, max-age=31536000, immutable"
"""For a file whose address changes with its content: browsers keep it for good."""

ASKED_FOR = "no-cache"
"""For one whose address stays: browsers ask each time whether theirs is the newest."""

_LEVEL = 6


@dataclass(frozen=True)
class File:
    """A file as it is served.

    Attributes:
        kind: its media type.
        compressed: its content, as gzip has it.
        tag: changes with the content.
    """

    kind: str
    compressed: bytes
    tag: str


def file(kind: str, content: bytes) -> File:
    """A file of this content."""
    return File(kind, gzip.compress(content, _LEVEL, mtime=0), f'"{hashlib.sha256(content).hexdigest()[:16]}"')


class Shelf:
    """Serves files by the rest of their address, which the route names `path`.

    Args:
        files: by their addresses.
        caching: how long a browser may keep them, as the header says it.
    """

    def __init__(self, files: Mapping[str, File], caching: str) -> None:
        self._files = files
        self._caching = caching

    @property
    def size(self) -> int:
        """Of all files together, as they are sent [byte]."""
        return sum(len(one.compressed) for one in self._files.values())

    async def serve(self, request: Request) -> Response:
        """Answer a browser."""
        found = self._files.get(request.path_params["path"])
        if found is None:
            return PlainTextResponse("There is no such file.", status_code=404)
        headers = {"Cache-Control": self._caching, "ETag": found.tag}
        if request.headers.get("If-None-Match") == found.tag:
            return Response(status_code=304, headers=headers)
        return Response(found.compressed, media_type=found.kind, headers={"Content-Encoding": "gzip", **headers})
