"""How the product's Python is started, so that it runs the product and nothing that lies about.

Other projects have folders called `services` or `sim` too, and put them into PYTHONPATH; a `sitecustomize` of theirs,
or a variable that makes warnings errors, would otherwise act in a robot's process.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path

import services

ROOT = Path(services.__file__).parent.parent
"""Where the packages lie: the checkout of an editable installation, else the environment's packages."""

_MAIN = str(Path(services.__file__).parent / "__main__.py")


_BLIND = {"PYTHONSAFEPATH": "1", "PYTHONNOUSERSITE": "1", "PYTHONUTF8": "1"}
"""What `-I -X utf8` says, as variables: not every library that starts a Python of its own hands flags on."""


def isolate_children() -> None:
    """Let every Python that this process starts from now on be isolated as it is itself."""
    for name in [name for name in os.environ if name.startswith("PYTHON")]:
        del os.environ[name]
    os.environ.update(_BLIND)


def retouch_command(arguments: Sequence[str]) -> list[str]:
    """The command line of a `retouch` command of this very code, blind to Python's variables and the working folder."""
    return [sys.executable, "-I", "-X", "utf8", _MAIN, *arguments]
