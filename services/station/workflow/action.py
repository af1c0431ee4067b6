"""What the operator may do, by the name of its press."""

from __future__ import annotations

from enum import Enum


class Action(Enum):
    """What the operator may do."""

    EXECUTE = "execute"
    REFINE = "refine"
    FINISH = "finish"
    GO_ON = "go_on"
    TEACH = "teach"
    NEXT = "next"
    UNDO = "undo"
    END = "end"
    RELEASE_STOP = "release_stop"
    ASK = "ask"
    TAKE_OVER = "take_over"
    PACE = "pace"
    PAUSE = "pause"
    PLAY = "play"
    STEP_BACK = "step_back"
    STEP_ON = "step_on"
    SEEK = "seek"
    PART = "part"
    TAKE_BACK = "take_back"
    USE_AGAIN = "use_again"
    CONFIDENCE = "confidence"
    METHOD = "method"
    BASIS = "basis"
    LEAD = "lead"
    LOOK = "look"
    STORE = "store"
    DELETE = "delete"
    EARLIER = "earlier"
    LATER = "later"
    CLEAR = "clear"
    PUT = "put"
    OTHER_PLACE = "other_place"
    REPEAT = "repeat"
    ENOUGH = "enough"
    SKILL = "skill"
    NEW_SKILL = "new_skill"


CHANGES = frozenset(
    {
        Action.PACE,
        Action.PAUSE,
        Action.PLAY,
        Action.STEP_BACK,
        Action.STEP_ON,
        Action.SEEK,
        Action.PART,
        Action.CONFIDENCE,
        Action.UNDO,
        Action.TAKE_BACK,
        Action.USE_AGAIN,
        Action.SKILL,
        Action.NEW_SKILL,
    }
)
"""Of how a motion goes on, of what of it counts and how much, of what was learnt, and into which skill."""
