"""How a payload announces its schema, so that a reader can refuse another version before it decodes."""

from __future__ import annotations

import zenoh

ENCODING = "application/msgpack"


def announced(encoding: zenoh.Encoding) -> str:
    """The schema that the sender announced; empty for none."""
    _, _, schema = str(encoding).partition(";")
    return schema


def encoding(schema: str) -> zenoh.Encoding:
    """MessagePack of this schema."""
    return zenoh.Encoding(ENCODING).with_schema(schema)
