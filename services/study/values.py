"""What the events of a study consist of, and their common form."""

from __future__ import annotations

from typing import Annotated

import msgspec

Number = Annotated[int, msgspec.Meta(ge=1, le=9999)]
Seconds = Annotated[float, msgspec.Meta(ge=0.0, le=1e6)]
Short = Annotated[str, msgspec.Meta(max_length=200)]
Long = Annotated[str, msgspec.Meta(max_length=4000)]

Answer = bool | int | float | Annotated[str, msgspec.Meta(max_length=4000)]
"""To one question."""


class Recorded(msgspec.Struct, frozen=True, kw_only=True, tag_field="event", forbid_unknown_fields=True):
    """Base of all of them."""
