"""A live view without its drawing: the viewer's own page, whose keys it hands over, on a server of its own."""

import http.server
import threading
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "services" / "viewer" / "page" / "page.js"

PAGE = b"""<!doctype html><title>live view</title>
<input id="view"><p id="state"></p>
<script>const wasm_bindgen = () => new Promise(() => {});</script>
<script src="page.js"></script>"""


class Frame:
    """Serves it on an address of this machine.

    Args:
        host: that it listens on.
    """

    def __init__(self, host="127.0.0.1"):
        self.loads = 0
        counted = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                script = self.path == "/page.js"
                counted.loads += not script
                self.send_response(200)
                self.send_header("Content-Type", "text/javascript" if script else "text/html")
                self.end_headers()
                self.wfile.write(SCRIPT.read_bytes() if script else PAGE)

            def log_message(self, *arguments):
                pass

        self._server = http.server.ThreadingHTTPServer((host, 0), Handler)
        self.url = f"http://{host}:{self._server.server_address[1]}/"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def close(self):
        self._server.shutdown()
        self._server.server_close()
