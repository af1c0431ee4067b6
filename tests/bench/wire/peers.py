"""What others send messages with, in an environment of its own in the user's cache: no part of the project needs it."""

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

INSTALLS_S = 300.0
PIP = ("-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--only-binary", ":all:")


@dataclass(frozen=True)
class Peer:
    """Packages of another way: how they are pinned, and what is imported of them."""

    pins: tuple[str, ...]
    modules: tuple[str, ...]


PEERS = {
    "pyzmq": Peer(("pyzmq==27.3.0",), ("zmq",)),
    "cyclonedds": Peer(("cyclonedds==11.0.1",), ("cyclonedds.core",)),
    "mqtt": Peer(("paho-mqtt==2.2.0", "amqtt==0.12.1"), ("paho.mqtt.client", "amqtt.broker")),
}
"""By their carrier's name."""


def folder():
    """Where the environment is."""
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(cache) / "retouch" / "bench-peers"


def python_of(carrier):
    """The interpreter that has what a carrier needs, installed now where it is not there yet.

    Raises:
        Absent: it cannot be installed.
    """
    if carrier not in PEERS:
        return Path(sys.executable)
    peer, python = PEERS[carrier], folder() / "bin" / "python"
    if not python.exists():
        _run([sys.executable, "-m", "venv", folder()], carrier)
    check = [python, "-I", "-c", "".join(f"import {module}\n" for module in peer.modules)]
    if subprocess.run(check, capture_output=True, check=False).returncode != 0:
        print(f"bench: installing {' '.join(peer.pins)} into {folder()} (once)", file=sys.stderr)
        _run([python, "-I", *PIP, *peer.pins], carrier)
        _run(check, carrier)
    return python


class Absent(Exception):
    """A way that cannot be had here; says why in one line."""


def _run(command, carrier):
    try:
        subprocess.run(command, capture_output=True, check=True, text=True, timeout=INSTALLS_S)
    except (OSError, subprocess.SubprocessError) as error:
        said = (getattr(error, "stderr", "") or str(error)).strip().splitlines()
        raise Absent(f"{carrier} is left out: {said[-1] if said else error}") from None
