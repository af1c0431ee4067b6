"""Who may command, and who shall: asked, answered, given back, taken away."""

from __future__ import annotations

import msgspec

from protocol.messages import Count, Name, Reason
from protocol.queries.answer import Change


class AcquireAuthority(Change, frozen=True):
    """Get the authority to command, where nobody else has it.

    Attributes:
        holder: the station's name.
        operator: the person at it.
        take_over: end another holder's lease at once.
        reason: why it is taken over, for who loses it.
    """

    holder: Name
    operator: Name = ""
    take_over: bool = False
    reason: Reason = ""


class AuthorityGranted(msgspec.Struct, frozen=True, tag_field="reply", tag="granted"):
    """The lease: renew it on its topic, put the epoch into every command."""

    epoch: Count
    lease_s: float


class ReleaseAuthority(Change, frozen=True):
    """Give the authority back."""

    holder: Name
    epoch: Count


class AnswerRequest(Change, frozen=True):
    """Give the authority to who asks for it, or keep it.

    Attributes:
        holder: that has it.
        epoch: of its authority.
        number: of the request that is answered.
        give: whether it is given.
    """

    holder: Name
    epoch: Count
    number: Count
    give: bool


class RevokeAuthority(Change, frozen=True):
    """Take the authority from whoever holds it, without taking it oneself: the robot holds.

    Attributes:
        by: who revokes it.
        reason: why, for who loses it.
    """

    by: Name
    reason: Reason
