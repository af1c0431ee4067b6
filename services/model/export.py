"""A skill as a single file that can be sent: MessagePack of plain values behind a digest, with a schema of its own.

    RTCHSKIL   8 bytes, by which the file is known
    version    2 bytes, little endian
    length     8 bytes, of what follows the digest
    digest     32 bytes, SHA-256 of version, length and what follows
    content    `Content` as MessagePack

Nothing in it can be executed, and nothing of it is believed before the digest is right and every size is within bounds.
"""

from __future__ import annotations

import hashlib
import math
import os
import struct
from pathlib import Path
from typing import Annotated

import msgspec

from lfd.store.stored import About, Binding, Change, Record, Turn
from lfd.store.whole import NAMES, Whole
from protocol.messages import Name
from services.model.exceptions import ExportUnusable, NoSkillIn

SUFFIX = ".retouch-skill"
VERSION = 1
LARGEST = 256 << 20
"""Bytes of an export, at most; a demonstration has some twenty thousand."""

_MAGIC = b"RTCHSKIL"
_HEAD = struct.Struct("<HQ")
_DIGEST = hashlib.sha256().digest_size
_BEFORE = len(_MAGIC) + _HEAD.size + _DIGEST
_ANOTHER = "take another copy of it"

_Text = Annotated[str, msgspec.Meta(max_length=10_000)]
_Stored = Annotated[int, msgspec.Meta(ge=-(2**63), le=2**63 - 1)]
_Whole = Annotated[int, msgspec.Meta(ge=0, le=2**53)]


class _Array(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Shape as numbers with commas, bytes in the order of the rows."""

    name: Name
    dtype: Name
    shape: Name
    data: Annotated[bytes, msgspec.Meta(max_length=64 << 20)]


class _Demonstration(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Its numbers and texts by name, and its arrays."""

    values: Annotated[dict[Name, _Text | _Stored | float | None], msgspec.Meta(max_length=64)]
    arrays: Annotated[tuple[_Array, ...], msgspec.Meta(max_length=16)]

    def __post_init__(self) -> None:
        values = self.values
        unknown = sorted(values.keys() - set(NAMES))
        if unknown:
            raise ValueError(f"nobody knows {unknown[0]!r}")
        if "added" not in values:
            raise ValueError("a demonstration does not say its version")
        if any(isinstance(value, float) and not math.isfinite(value) for value in values.values()):
            raise ValueError("a number is not finite")
        if (values.get("departure_mean") is None) is not (values.get("departure_most") is None):
            raise ValueError("a departure is half there")


class _Turned(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A change; see `lfd.store.stored.Change`."""

    demonstration: _Whole
    version: _Whole
    in_use: bool
    author: _Text
    at_s: float | None


class Content(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What an export holds.

    Attributes:
        name: of the skill, where it was exported.
        task: that it is for.
        robot_kind: the kind of robot that it is for.
        author: who made it.
        notes: for people.
        created_s: when, since 1970-01-01 UTC [s].
        demonstrations: every one that was ever added.
        changes: every one.
    """

    name: _Text
    task: _Text
    robot_kind: _Text
    author: _Text
    notes: _Text
    created_s: float | None
    demonstrations: Annotated[tuple[_Demonstration, ...], msgspec.Meta(max_length=100_000)]
    changes: Annotated[tuple[_Turned, ...], msgspec.Meta(max_length=1_000_000)]

    @property
    def whole(self) -> Whole:
        """As a file of demonstrations holds it."""
        return Whole(
            About(Binding(self.task, self.robot_kind), self.author, self.notes, self.created_s),
            tuple(
                Record(dict(one.values), tuple((a.name, a.dtype, a.shape, a.data) for a in one.arrays))
                for one in self.demonstrations
            ),
            tuple(Change(c.demonstration, Turn(c.version, c.in_use, c.author, c.at_s)) for c in self.changes),
        )


def exported(name: str, whole: Whole) -> bytes:
    """The file of a skill.

    Args:
        name: of the skill.
        whole: what it holds.

    Raises:
        ExportUnusable: it is larger than an import takes.
    """
    about = whole.about
    content = msgspec.msgpack.encode(
        Content(
            name,
            *about.binding,
            about.author,
            about.notes,
            about.created_s,
            tuple(_Demonstration(one.values, tuple(_Array(*array) for array in one.arrays)) for one in whole.records),
            tuple(
                _Turned(c.demonstration, c.turn.version, c.turn.in_use, c.turn.author, c.turn.at_s)
                for c in whole.changes
            ),
        )
    )
    if _BEFORE + len(content) > LARGEST:
        raise ExportUnusable(Path(name), f"its export is larger than {LARGEST >> 20} MiB", "copy the skill's file")
    head = _HEAD.pack(VERSION, len(content))
    return _MAGIC + head + hashlib.sha256(head + content).digest() + content


def read_export(path: Path) -> Content:
    """What the file of an export holds.

    Raises:
        ExportUnusable: it cannot be read, is no export, not whole, not as it was written, of another version or larger
            than any; says which.
    """
    data = _bytes_of(path)
    if not data.startswith(_MAGIC) or len(data) < _BEFORE:
        known = bool(data) and _MAGIC.startswith(data[: len(_MAGIC)])
        raise ExportUnusable(path, "it breaks off" if known else "it is no export of a skill", _ANOTHER)
    begin = len(_MAGIC) + _HEAD.size
    head, digest, content = data[len(_MAGIC) : begin], data[begin:_BEFORE], data[_BEFORE:]
    version, length = _HEAD.unpack(head)
    if version != VERSION:
        remedy = "update Retouch" if version > VERSION else _ANOTHER
        raise ExportUnusable(path, f"its version {version} is not {VERSION}", remedy)
    if len(content) < length:
        raise ExportUnusable(path, f"it breaks off: {len(content)} of {length} bytes are there", _ANOTHER)
    if hashlib.sha256(head + content).digest() != digest:
        raise ExportUnusable(path, "it is not as it was written: its digest is another one", _ANOTHER)
    try:
        return msgspec.msgpack.decode(content, type=Content)
    except (msgspec.MsgspecError, RecursionError) as error:
        raise NoSkillIn(path, str(error)) from None


def _bytes_of(path: Path) -> bytes:
    if path.exists() and not path.is_file():
        raise ExportUnusable(path, "it is no file", "name one")
    try:
        with path.open("rb") as file:
            size = os.fstat(file.fileno()).st_size
            data = file.read(LARGEST + 1) if size <= LARGEST else b""
    except OSError as error:
        raise ExportUnusable(path, (error.strerror or str(error)).lower(), "name another file") from None
    if size > LARGEST or len(data) > LARGEST:
        raise ExportUnusable(path, f"it is larger than {LARGEST >> 20} MiB", "no export is as large")
    return data
