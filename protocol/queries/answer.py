"""What any request may come to, and what makes one that changes something known again."""

from __future__ import annotations

import msgspec

from protocol.messages import Count, Text


class Refused(msgspec.Struct, frozen=True, tag_field="reply", tag="refused"):
    """The answer to a request that was understood and not carried out.

    Attributes:
        reason: why not, for people.
        lasting: asking again does not help; what was asked for has to be another.
    """

    reason: Text
    lasting: bool = False


class Accepted(msgspec.Struct, frozen=True, tag_field="reply", tag="accepted"):
    """The request is carried out."""


class Change(msgspec.Struct, frozen=True, kw_only=True):
    """A request that changes something: asked twice, done once.

    Attributes:
        request: a random number by which the request is known again, so that a repeated one gets the kept answer and
            changes nothing; 0 for a request that is never repeated.
    """

    request: Count = 0
