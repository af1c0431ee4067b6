"""The standard streams, so that a lost terminal, a closed pipe or a narrow alphabet never ends a program."""

from __future__ import annotations

import contextlib
import io
import locale
import logging
import os
import sys
from typing import TextIO

_STREAMS = (("stdin", "r"), ("stdout", "w"), ("stderr", "w"))


def prepare() -> None:
    """Open what is closed, and let the streams replace what they cannot write, line by line."""
    logging.raiseExceptions = False  # a log that cannot be written is no reason for anything
    for number, (name, mode) in enumerate(_STREAMS):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest free number: this one
        if getattr(sys, name) is None:
            setattr(sys, name, os.fdopen(number, mode, closefd=False))
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(encoding=_encoding(stream), errors="replace", line_buffering=True)


def _encoding(stream: TextIO) -> str:
    """A person's terminal has an alphabet of its own; programs read UTF-8."""
    return locale.getencoding() if stream.isatty() else "utf-8"


def leave() -> None:
    """Write what is left; where nobody reads it, nobody is told of it either."""
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            with contextlib.suppress(OSError):
                nothing = os.open(os.devnull, os.O_WRONLY)
                os.dup2(nothing, stream.fileno())
                os.close(nothing)
