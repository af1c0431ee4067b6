"""Files that a person writes: TOML, or JSON, into frozen structs, in UTF-8 or UTF-16, whoever wrote them."""

from __future__ import annotations

import codecs
import re
from pathlib import Path
from typing import TypeVar

import msgspec

from services.process.exceptions import ConfigurationError
from services.process.misfit import told

LARGEST = 1 << 20
"""Of such a file [byte]; more is some other one."""

_BYTE = re.compile(r"\(byte (\d+)\)")

S = TypeVar("S", bound=msgspec.Struct)


def read(path: Path, type_: type[S], what: str) -> S:
    """What a file says.

    Args:
        path: of the file; JSON where its name ends so.
        type_: that it has to fit.
        what: it is, as an error names it.

    Raises:
        ConfigurationError: it is not there, cannot be parsed, or has a wrong key, type or value; says which.
    """
    text = _text(path, what)
    decode = msgspec.json.decode if path.suffix == ".json" else msgspec.toml.decode
    try:
        written = decode(text)
        return decode(text, type=type_)
    except RecursionError:
        raise ConfigurationError(path, f"it is nested too deeply for a {what}", what) from None
    except msgspec.ValidationError as error:
        raise ConfigurationError(path, told(error, type_, written), what) from None
    except msgspec.DecodeError as error:
        raise ConfigurationError(path, _BYTE.sub(lambda m: _place(text, int(m[1])), str(error)), what) from None


def _text(path: Path, what: str) -> str:
    """The file's text, its lines ended as everywhere."""
    try:
        if path.exists() and not path.is_file():
            kind = "folder" if path.is_dir() else "pipe or device"
            raise ConfigurationError(path, f"it is a {kind}; name a file", what)
        if path.stat().st_size > LARGEST:
            raise ConfigurationError(path, f"it is larger than {LARGEST >> 20} MiB: no {what}", what)
        content = path.read_bytes()
    except OSError as error:
        raise ConfigurationError(path, error.strerror or str(error), what) from None
    wide = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    try:
        text = content.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        reason = f"line {line} holds a byte (0x{content[error.start]:02x}) that is no UTF-8: save the file as UTF-8"
        raise ConfigurationError(path, reason, what) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _place(text: str, byte: int) -> str:
    """What the JSON parser calls by its byte, by its line, as people do."""
    return f"(line {text.encode()[:byte].count(10) + 1})"
