"""The live view's page: the Rerun web viewer without its surroundings, and without a word to any other host."""

from __future__ import annotations

import logging
import threading
from collections.abc import Mapping
from dataclasses import dataclass
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from string import Template
from typing import Any

from services.process.config import Configuration
from services.process.exceptions import PortInUse
from services.viewer.recording import public_host
from services.viewer.web_files import FILES

log = logging.getLogger(__name__)

_PAGE = Path(__file__).parent / "page"
_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".css": "text/css",
    ".js": "text/javascript",
    ".wasm": "application/wasm",
}


@dataclass(frozen=True)
class _File:
    kind: str
    content: bytes
    gzipped: bool = False


class WebServer:
    """Serves the page in threads of its own.

    Args:
        configuration: of the whole system: where to listen, and which page may hold this one in a frame.
        files: folder with the Rerun web viewer's files, as `web_files` gives it.

    Raises:
        PortInUse: nothing can listen at the page's port.
    """

    def __init__(self, configuration: Configuration, files: Path) -> None:
        section = configuration.viewer
        host = public_host(section.host)
        stream = f"{host}:{section.stream_port}"
        contents = _contents(files, f"rerun+http://{stream}/proxy")
        headers = {
            "Content-Security-Policy": _policy(stream, configuration),
            "Cross-Origin-Resource-Policy": "cross-origin",
            "X-Content-Type-Options": "nosniff",
            "Referrer-Policy": "no-referrer",
            "Cache-Control": "no-cache",
        }

        class Handler(_Handler):
            served = contents
            common = headers

        try:
            self._server = _Server((section.host, section.web_port), Handler)
        except OSError as error:
            reason = error.strerror or ""
            raise PortInUse("the live view", section.host, section.web_port, "[viewer] web_port", reason) from None
        self.url = f"http://{host}:{section.web_port}/"
        self._thread = threading.Thread(target=self._server.serve_forever, name="live view's page", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Stop listening."""
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


class _Server(ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, request: object, client_address: object) -> None:
        """A browser that goes away in the middle of an answer is no fault of anybody's."""
        log.debug("the live view's page lost %s", client_address)


class _Handler(BaseHTTPRequestHandler):
    served: Mapping[str, _File]
    common: Mapping[str, str]
    timeout = 30.0  # [s] for a client that says nothing

    def do_GET(self) -> None:
        file = self.served.get(self.path.partition("?")[0])
        if file is None:
            self.send_error(HTTPStatus.NOT_FOUND)
            return
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", file.kind)
        self.send_header("Content-Length", str(len(file.content)))
        if file.gzipped:
            self.send_header("Content-Encoding", "gzip")
        for name, value in self.common.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(file.content)

    def log_message(self, format: str, *args: Any) -> None:  # noqa: A002 - the base class names it so
        """Say nothing: requests are no news."""


def _contents(files: Path, stream: str) -> dict[str, _File]:
    page = Template((_PAGE / "index.html").read_text()).substitute(stream=stream)
    contents = {"/": _File(_TYPES[".html"], page.encode())}
    for name in ("style.css", "page.js"):
        contents[f"/{name}"] = _File(_TYPES[Path(name).suffix], (_PAGE / name).read_bytes())
    for name in FILES:
        contents[f"/{name}"] = _File(_TYPES[Path(name).suffix], (files / f"{name}.gz").read_bytes(), gzipped=True)
    return contents


def _policy(stream: str, configuration: Configuration) -> str:
    """What the page may load: its own files and the stream, nothing else."""
    frames = {public_host(configuration.viewer.host), configuration.station.host, "localhost", "127.0.0.1"}
    return "; ".join(
        (
            "default-src 'none'",
            "script-src 'self' 'wasm-unsafe-eval'",
            "style-src 'self' 'unsafe-inline'",
            "img-src 'self' data: blob:",
            f"connect-src 'self' http://{stream}",
            f"frame-ancestors {' '.join(f'http://{host}:*' for host in sorted(frames))}",
        )
    )
