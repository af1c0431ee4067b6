"""The Rerun web viewer's own files, taken from the installed SDK once and kept compressed.

They lie inside the SDK's program, which gives them out over HTTP only: it is started for a moment, on loopback.
"""

from __future__ import annotations

import gzip
import http.client
import importlib.util
import logging
import os
import subprocess
import time
from importlib.metadata import version
from pathlib import Path

from services.process.ports import free_port
from services.viewer.exceptions import WebFilesMissing
from sim.cache import kept

log = logging.getLogger(__name__)

FILES = ("re_viewer.js", "re_viewer_bg.wasm")

_START_TIMEOUT_S = 20.0
_RETRY_S = 0.1
_LEVEL = 6


def web_files(cache: Path | None = None) -> Path:
    """The folder with each of `FILES`, gzipped, ".gz" appended; made at first use.

    Args:
        cache: where to keep it; see `sim.cache`.

    Raises:
        WebFilesMissing: the SDK's program is not there or does not give them.
        CacheUnusable: there is no place for them.
    """
    return kept(f"rerun-web-{version('rerun-sdk')}", _make, cache)


def _make(scratch: Path, target: Path) -> None:
    del target
    log.info("preparing the page for inspection, once: some seconds")
    scratch.mkdir()
    for name, content in _take().items():
        (scratch / f"{name}.gz").write_bytes(gzip.compress(content, _LEVEL))


def sdk_program() -> Path:
    """The SDK's program `rerun`.

    Raises:
        WebFilesMissing: it is not there.
    """
    package = importlib.util.find_spec("rerun_cli")
    for folder in (package.submodule_search_locations or []) if package else []:
        program = Path(folder) / "rerun"
        if program.is_file():
            return program
    raise WebFilesMissing("its program is not installed")


def _take() -> dict[str, bytes]:
    port = free_port()
    command = [str(sdk_program()), "--serve-web", "--bind", "127.0.0.1", "--web-viewer-port", str(port)]
    server = subprocess.Popen(
        [*command, "--port", str(free_port())],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "RERUN_ANALYTICS": "0"},
    )
    try:
        return {name: _get(port, name) for name in FILES}
    finally:
        server.kill()
        server.wait()


def _get(port: int, name: str) -> bytes:
    deadline = time.monotonic() + _START_TIMEOUT_S
    while True:
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=_START_TIMEOUT_S)
        try:
            connection.request("GET", f"/{name}")
            response = connection.getresponse()
            if response.status != http.HTTPStatus.OK:
                raise WebFilesMissing(f"{name}: {response.status} {response.reason}")
            return response.read()
        except (OSError, http.client.HTTPException) as error:
            if time.monotonic() > deadline:
                raise WebFilesMissing(f"no answer in {_START_TIMEOUT_S:.0f} s: {error}") from None
            time.sleep(_RETRY_S)
        finally:
            connection.close()
