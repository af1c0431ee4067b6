"""Asks for a file as a browser does."""

import asyncio

from starlette.requests import Request

from services.station.live_view.description import described
from services.station.live_view.files import Files
from sim.tasks.scene import Eye

VIEW = Files(described((), {}, Eye(), None))
"""What the live view loads where there is nothing to be seen."""


def ask(shelf, path, **headers):
    """The answer to a request.

    Args:
        shelf: that is asked.
        path: the rest of the address.
        headers: of the request, "_" in their names for "-".
    """
    told = [(name.replace("_", "-").lower().encode(), value.encode()) for name, value in headers.items()]
    request = Request({"type": "http", "method": "GET", "headers": told, "path_params": {"path": path}})
    return asyncio.run(shelf.serve(request))
