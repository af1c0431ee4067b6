"""The page to inspect everything on: the Rerun web viewer without its surroundings, and without a word to others."""

from __future__ import annotations

import logging
import re
import threading
from collections.abc import Mapping
from dataclasses import dataclass
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from socketserver import TCPServer
from string import Template
from typing import Any

from services.process.addresses import LOOPBACK_NAMES, family, in_url
from services.process.config import ViewerSection
from services.process.exceptions import PortInUse
from services.viewer.web_files import FILES

log = logging.getLogger(__name__)

_PAGE = Path(__file__).parent / "page"
_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css",
    ".js": "text/javascript",
    ".wasm": "application/wasm",
}

_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-cache",
}

# It stops listening within this time.
_POLL_S = 0.05

# A host and a port, as a browser says whom it asks.
_NAME = re.compile(r"(?P<name>[0-9A-Za-z._-]+|\[[0-9A-Fa-f:.]+\])(:[0-9]+)?")


@dataclass(frozen=True)
class _File:
    kind: str
    content: bytes
    gzipped: bool = False


class WebServer:
    """Serves the page in threads of its own.

    Args:
        section: where to listen, and where the stream is.
        files: folder with the Rerun web viewer's files, as `web_files` gives it.

    Raises:
        PortInUse: nothing can listen at the page's port.
    """

    def __init__(self, section: ViewerSection, files: Path) -> None:
        contents = _contents(files, section.stream_port)

        class Handler(_Handler):
            served = contents
            here_only = section.host in LOOPBACK_NAMES
            stream_port = section.stream_port

        class Server(_Server):
            address_family = family(section.host)

        try:
            self._server = Server((section.host, section.web_port), Handler)
        except OSError as error:
            reason = error.strerror or ""
            raise PortInUse("the viewer's page", section.host, section.web_port, "[viewer] web_port", reason) from None
        self.url = f"http://{in_url(section.host)}:{section.web_port}/"
        self._thread = threading.Thread(
            target=self._server.serve_forever, args=(_POLL_S,), name="viewer's page", daemon=True
        )
        self._thread.start()

    def close(self) -> None:
        """Stop listening."""
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


class _Server(ThreadingHTTPServer):
    daemon_threads = True

    def server_bind(self) -> None:
        """Listen, without asking the name service who this host is: nobody needs it, and it may take seconds."""
        TCPServer.server_bind(self)

    def handle_error(self, request: object, client_address: object) -> None:
        """A browser that goes away in the middle of an answer is no fault of anybody's."""
        log.debug("the viewer's page lost %s", client_address)


class _Handler(BaseHTTPRequestHandler):
    served: Mapping[str, _File]
    here_only: bool
    stream_port: int
    timeout = 30.0  # [s] for a client that says nothing

    def do_GET(self) -> None:
        file = self.served.get(self.path.partition("?")[0])
        if file is None:
            self.send_error(HTTPStatus.NOT_FOUND)
            return
        name = self._asked_name()
        if name is None:
            self.send_error(HTTPStatus.MISDIRECTED_REQUEST, "Open the view under the address that it is served on.")
            return
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", file.kind)
        self.send_header("Content-Length", str(len(file.content)))
        if file.gzipped:
            self.send_header("Content-Encoding", "gzip")
        self.send_header("Content-Security-Policy", _policy(name, self.stream_port))
        for header, value in _HEADERS.items():
            self.send_header(header, value)
        self.end_headers()
        self.wfile.write(file.content)

    def _asked_name(self) -> str | None:
        """The name by which the browser knows this host, as it stands in an address; None where it may not.

        Who listens on loopback answers to loopback names only: no foreign name can be pointed here (DNS rebinding).
        """
        match = _NAME.fullmatch(self.headers.get("Host", ""))
        if match is None or (self.here_only and match["name"].strip("[]") not in LOOPBACK_NAMES):
            return None
        return match["name"]

    def log_message(self, format: str, *args: Any) -> None:  # noqa: A002 - the base class names it so
        """Say nothing: requests are no news."""


def _contents(files: Path, stream_port: int) -> dict[str, _File]:
    page = Template((_PAGE / "index.html").read_text()).substitute(stream_port=stream_port)
    contents = {"/": _File(_TYPES[".html"], page.encode())}
    for name in ("style.css", "page.js"):
        contents[f"/{name}"] = _File(_TYPES[Path(name).suffix], (_PAGE / name).read_bytes())
    for name in FILES:
        contents[f"/{name}"] = _File(_TYPES[Path(name).suffix], (files / f"{name}.gz").read_bytes(), gzipped=True)
    return contents


def _policy(name: str, stream_port: int) -> str:
    """What the page may load, its own files and the stream, nothing else; and that it is nobody's part.

    Args:
        name: by which the browser knows this host.
        stream_port: of the stream.
    """
    # A policy has no way to write an IPv6 address.
    stream = "*" if name.startswith("[") else name
    return "; ".join(
        (
            "default-src 'none'",
            "script-src 'self' 'wasm-unsafe-eval'",
            "style-src 'self' 'unsafe-inline'",
            "img-src 'self' data: blob:",
            f"connect-src 'self' http://{stream}:{stream_port}",
            "frame-ancestors 'none'",
        )
    )
