"""What a model process tells of a robot's skills, and which of them it is to use."""

from __future__ import annotations

from typing import Annotated

import msgspec

from protocol.messages import Count, Name, Reason
from protocol.queries.answer import Change

SKILLS_AT_ONCE = 256


class ListSkills(msgspec.Struct, frozen=True):
    """Ask for all skills of the robot."""


class SkillEntry(msgspec.Struct, frozen=True, kw_only=True):
    """A skill.

    Attributes:
        name: by which it is called.
        task: that it is for; empty where nothing says so.
        robot_kind: the kind of robot that it is for; empty for any.
        version: of its model.
        demonstrations: that it starts from.
        updates: since then.
        author: who made it; empty where nobody says so.
        notes: for people, as far as they are told.
        created: UTC, ISO 8601; empty where that is not known.
        used: when it was taken into use last; see `created`.
        misfit: why it cannot be used here and now; empty where it can.
    """

    name: Name
    task: Name
    robot_kind: Name
    version: Count
    demonstrations: Count
    updates: Count
    author: Name = ""
    notes: Reason = ""
    created: Name = ""
    used: Name = ""
    misfit: Reason = ""


class SkillsListed(msgspec.Struct, frozen=True, tag_field="reply", tag="skills"):
    """All skills of the robot, by their names.

    Attributes:
        in_use: which of them predicts and learns.
        skills: at most 256.
    """

    in_use: Name
    skills: Annotated[tuple[SkillEntry, ...], msgspec.Meta(max_length=SKILLS_AT_ONCE)]


class ChooseSkill(Change, frozen=True):
    """Use another skill from now on.

    Attributes:
        name: of the skill.
        new: it is made, with nothing learnt.
        notes: of a new one.
        operator: who chooses it, and makes a new one.
    """

    name: Name
    new: bool = False
    notes: Reason = ""
    operator: Name = ""
