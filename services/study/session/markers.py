"""Markers for other recorders of a laboratory, by the Lab Streaming Layer, where its package is installed.

Each event of the journal is one, in the moment in which it is on the disk: `attempted P01 OnKey/2 3`.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

from services.study.events import Attempted, Entry
from services.study.records import code

Marked = Callable[[Entry], None]
"""Called with every entry once it is written."""


def stream(study: str) -> str:
    """Name and source of a study's markers.

    Args:
        study: its name.
    """
    return f"retouch-{study}"


def lab_streaming(study: str) -> Marked | None:
    """An outlet for a study's markers; None where pylsl is not installed.

    Args:
        study: its name.
    """
    try:
        lsl: Any = importlib.import_module("pylsl")
    except (ImportError, RuntimeError):  # the package without the library that it loads
        return None
    outlet = lsl.StreamOutlet(lsl.StreamInfo(stream(study), "Markers", 1, 0, "string", stream(study)))
    return lambda entry: outlet.push_sample([marker(entry)])


def marker(entry: Entry) -> str:
    """What is told of an entry: what happened, to whom, in which part."""
    event = entry.event
    number = getattr(event, "participant", None)
    told = [str(event.__struct_config__.tag), code(number) if number else "", getattr(event, "part", "")]
    if isinstance(event, Attempted):
        told.append(str(event.number))
    return " ".join(word for word in told if word)
