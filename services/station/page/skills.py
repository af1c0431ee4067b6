"""The skills' region: which one is in use, which others the robot has, and which of them do not fit here."""

from __future__ import annotations

from functools import lru_cache

import msgspec

from protocol.queries import SkillEntry, SkillsListed
from services.station.page.values import Values
from services.station.page.view import Shown
from services.station.words.heard import heard
from services.station.words.table import say

CONTROLS = ("skill", "new_skill")
"""What is pressed here, by the names in `TeachingState.actions`."""


class Row(msgspec.Struct, frozen=True):
    """A skill in words.

    Attributes:
        name: by which a press names it.
        what: it is for, and what it has learnt.
        why: it cannot be used here; empty where it can.
        notes: for people.
    """

    name: str
    what: str
    why: str
    notes: str


def skills(shown: Shown) -> Values:
    """Everything that the region shows."""
    teaching, listed, model = shown.view.teaching, shown.view.skills, shown.view.model
    allowed = frozenset() if teaching is None else frozenset(teaching.actions)
    in_use = model.skill if model is not None else listed.in_use if listed is not None else ""
    return {
        "skill-name": in_use,
        "skills@data-in-use": in_use,
        "skills@data-allowed": " ".join(name for name in CONTROLS if name in allowed),
        "skills@data-listed": "[]" if listed is None else _rows(listed),
    }


@lru_cache(maxsize=4)
def _rows(listed: SkillsListed) -> str:
    return msgspec.json.encode([_row(entry) for entry in listed.skills]).decode()


def _row(entry: SkillEntry) -> Row:
    place = say("skills.place", task=entry.task or "-", robot=entry.robot_kind or say("skills.any_robot"))
    learnt = say("skills.learnt", shown=entry.demonstrations, corrected=entry.updates)
    is_elsewhere = entry.misfit and entry.task
    why = say("skills.elsewhere") if is_elsewhere else heard(entry.misfit)
    return Row(entry.name, f"{place}. {learnt}" if entry.task else "", why, entry.notes)
