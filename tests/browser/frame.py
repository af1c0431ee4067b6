"""The viewer's own page and server, without its drawing."""

import gzip

from services.process.config import ViewerSection
from services.viewer.web import WebServer
from services.viewer.web_files import FILES

SCRIPT = b"function wasm_bindgen() { return new Promise(() => {}); }"


class Frame:
    """A live view that is served.

    Args:
        folder: for its files.
        host: that it listens on.
        port: that is free there.
    """

    def __init__(self, folder, host, port):
        for name in FILES:
            (folder / f"{name}.gz").write_bytes(gzip.compress(SCRIPT))
        self._server = WebServer(ViewerSection(host=host, web_port=port), folder)
        self.url = self._server.url

    def close(self):
        self._server.close()
