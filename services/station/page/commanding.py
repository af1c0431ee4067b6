"""Who commands, as a tab says it: nothing else on the page claims it."""

from __future__ import annotations

import math

from services.station.page.standing import Standing
from services.station.page.values import Values
from services.station.page.view import Shown
from services.station.words.table import say


def commanding(shown: Shown, standing: Standing) -> Values:
    """Who commands, and who asks this tab's person for the robot."""
    authority = shown.view.authority
    mine = shown.view.authority_is_mine and standing.armed
    asked = mine and authority is not None and authority.asked > 0
    left_s = max(0.0, authority.asked_left - shown.elapsed_s) if authority is not None else 0.0
    who = authority.asked_by if authority is not None else ""
    return {
        "who-text": say("who.you") if mine else _who(shown),
        "who@data-tone": "good" if mine else "warn",
        "robot-asked@data-open": asked,
        "robot-asked-text": say("who.asked", name=who, seconds=math.ceil(left_s)) if asked else "",
    }


def _who(shown: Shown) -> str:
    authority = shown.view.authority
    holder = (authority.operator or authority.holder) if authority is not None else ""
    return say("who.other", name=holder) if holder else say("who.nobody")
