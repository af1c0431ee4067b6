"""PyAV, which brings FFmpeg's codecs; where it is not installed, pictures are JPEG."""

from __future__ import annotations

import importlib
import importlib.util
from types import ModuleType

from services.process.exceptions import RoomMissing

MODULE, EXTRA = "av", "video"


def is_installed() -> bool:
    """Whether pictures can be coded and decoded here."""
    return importlib.util.find_spec(MODULE) is not None


def library() -> ModuleType:
    """The module.

    Raises:
        RoomMissing: it is not installed.
    """
    try:
        return importlib.import_module(MODULE)
    except (ImportError, OSError):
        raise RoomMissing(EXTRA, MODULE) from None
