"""Whether a server can listen where it is to, asked before it is started."""

from __future__ import annotations

import socket

from services.process.addresses import family
from services.process.exceptions import PortInUse


def free_port(host: str = "127.0.0.1") -> int:
    """A port where nobody listens now; somebody may in a moment.

    Raises:
        OSError: there is none.
    """
    with socket.create_server((host, 0), family=family(host)) as listening:
        number: int = listening.getsockname()[1]
        return number


def check_port(what: str, host: str, port: int, setting: str) -> None:
    """Let it pass where a server could listen now.

    Args:
        what: is to be served, for people.
        host: address to listen on.
        port: there.
        setting: that names the port.

    Raises:
        PortInUse: nothing can listen there.
    """
    try:
        socket.create_server((host, port), family=family(host)).close()
    except OSError as error:
        raise PortInUse(what, host, port, setting, error.strerror or "") from None
