"""What a tab says of its seat: that it looks on, that it is asked for its seat, that its keys do not count yet."""

from __future__ import annotations

import math

from protocol.messages import Role
from services.station.page.standing import Standing
from services.station.page.values import Values
from services.station.words.table import say


def seating(standing: Standing) -> Values:
    """The banners' and the keys' words."""
    return {
        "view-only@data-asking": standing.asking_s > 0.0,
        "view-only@data-role": standing.identity.role.value,
        "view-only-text": _looking_on(standing),
        "asked@data-open": standing.asked_s > 0.0,
        "asked-text": say("seat.asked", name=_who(standing.asked_by), seconds=math.ceil(standing.asked_s)),
        "let-go": _not_counting(standing),
    }


def _looking_on(standing: Standing) -> str:
    if standing.asking_s > 0.0:
        return say("seat.asking", seconds=math.ceil(standing.asking_s))
    if standing.kept:
        return say("seat.kept")
    if standing.lost is not None:
        return say("seat.lost", name=_who(standing.lost.by), why=standing.lost.why)
    if standing.vacant and standing.identity.role is Role.OPERATOR:
        return say("seat.vacant")
    return say(f"seat.{standing.identity.role.value}")


def _who(name: str) -> str:
    return name or say("who.somebody_big")


def _not_counting(standing: Standing) -> str:
    if not standing.armed or not standing.let_go:
        return ""
    if not standing.heard:
        return say("pad.unheard")
    if not standing.focused:
        return say("pad.unfocused")
    return say("pad.let_go")
