"""The messages that a recording is made of, and where the last whole one ends.

A .rrd file is a header of 12 bytes and messages, each with its kind and its length before it (64 bit, little endian),
as the SDK writes them; one that was finished ends with a footer. Rerun opens no file that ends within a message.
"""

from __future__ import annotations

import struct
from pathlib import Path

_FILE_HEADER = 12
_MESSAGE_HEADER = struct.Struct("<QQ")
_FOOTER, _FOOTER_END = b"RRF2FOOT", 12


class Whole:
    """Bytes on their way to a file, let through by whole messages."""

    def __init__(self) -> None:
        self._held = bytearray()
        self._end = _FILE_HEADER

    def add(self, piece: bytes) -> bytes:
        """What is whole with this piece and was not let through yet."""
        self._held += piece
        while (length := _length(self._held[self._end : self._end + _MESSAGE_HEADER.size])) is not None:
            if self._end + length > len(self._held):
                break
            self._end += length
        if self._end > len(self._held):
            return b""
        whole = bytes(self._held[: self._end])
        del self._held[: self._end]
        self._end = 0
        return whole

    def rest(self) -> bytes:
        """What is still held: nothing follows it."""
        return bytes(self._held)


def whole_length(path: Path) -> int:
    """The length of a recording up to the end of its last whole message, or of its footer [byte].

    Raises:
        OSError: the file cannot be read.
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        file.seek(max(size - _FOOTER_END, 0))
        if file.read(len(_FOOTER)) == _FOOTER:
            return size
        whole = _FILE_HEADER
        while True:
            file.seek(whole)
            length = _length(file.read(_MESSAGE_HEADER.size))
            if length is None or whole + length > size:
                return min(whole, size)
            whole += length


def _length(header: bytes | bytearray) -> int | None:
    """A message's length with its header; None where that is not there as a whole."""
    return (
        _MESSAGE_HEADER.size + int(_MESSAGE_HEADER.unpack(header)[1]) if len(header) == _MESSAGE_HEADER.size else None
    )
