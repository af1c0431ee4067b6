"""The query registry: what is asked of which process."""

from __future__ import annotations

from typing import Any

from protocol.queries.answer import Accepted
from protocol.queries.authority import (
    AcquireAuthority,
    AnswerRequest,
    AuthorityGranted,
    ReleaseAuthority,
    RevokeAuthority,
)
from protocol.queries.command import EpisodeStarted, Execute, Finish, Pace, ReleaseStop, Reset, Resume, Teleoperate
from protocol.queries.history import Compare, Compared, HistoryListed, ListHistory
from protocol.queries.model import AddDemonstration, Describe, Learnt, Predict, Predicted, Redo, Undo
from protocol.queries.plan import Plan
from protocol.queries.query import Query
from protocol.queries.skills import ChooseSkill, ListSkills, SkillsListed

ACQUIRE = Query("authority/acquire", AcquireAuthority, AuthorityGranted, "robot", 20_480, "get the authority")
ANSWER = Query(
    "authority/answer", AnswerRequest, Accepted, "robot", 20_480, "give the authority to who asks, or keep it"
)
REVOKE = Query(
    "authority/revoke",
    RevokeAuthority,
    Accepted,
    "robot",
    20_480,
    "end the authority of whoever commands",
    askers=("station", "cli"),
)
RELEASE = Query("authority/release", ReleaseAuthority, Accepted, "robot", 20_480, "give the authority back")
EXECUTE = Query("cmd/execute", Execute, EpisodeStarted, "robot", 20_480, "execute a prediction")
TELEOPERATE = Query(
    "cmd/teleoperate", Teleoperate, EpisodeStarted, "robot", 20_480, "lead the robot by hand, without a prediction"
)
FINISH = Query("cmd/finish", Finish, Accepted, "robot", 20_480, "end the episode here")
PACE = Query("cmd/pace", Pace, Accepted, "robot", 20_480, "faster, slower, pause or back")
RESUME = Query("cmd/resume", Resume, Accepted, "robot", 20_480, "go on after a hold")
RESET = Query("cmd/reset", Reset, Accepted, "robot", 20_480, "back to the start")
RELEASE_STOP = Query(
    "safety/release_stop",
    ReleaseStop,
    Accepted,
    "robot",
    20_480,
    "release the emergency stop",
    askers=("station", "cli"),
)
PREDICT = Query("model/predict", Predict, Predicted, "model", 1_048_576, "predict a motion")
PLAN = Query(
    "model/plan",
    Plan,
    Predicted,
    "model",
    1_048_576,
    "make a motion of what an operator showed",
    askers=("station", "teach"),
)
ADD_DEMONSTRATION = Query(
    "model/add_demonstration",
    AddDemonstration,
    Learnt,
    "model",
    4_194_304,
    "learn; answered when it is on disk",
    askers=("station", "teach"),
)
UNDO = Query(
    "model/undo",
    Undo,
    Learnt,
    "model",
    20_480,
    "take the newest update back, or any demonstration",
    askers=("station", "teach", "history", "study"),
)
REDO = Query(
    "model/redo",
    Redo,
    Learnt,
    "model",
    20_480,
    "use a demonstration again that was taken back",
    askers=("station", "history"),
)
HISTORY = Query(
    "model/history",
    ListHistory,
    HistoryListed,
    "model",
    1_048_576,
    "what was learnt, by whom, and how far it led",
    askers=("station", "history"),
    looks=True,
)
COMPARE = Query("model/compare", Compare, Compared, "model", 1_048_576, "what a demonstration changes", looks=True)
DESCRIBE = Query(
    "model/describe",
    Describe,
    Learnt,
    "model",
    20_480,
    "the model as it lies on disk",
    askers=("station", "teach", "history", "cli"),
    looks=True,
)
SKILLS = Query(
    "model/skills",
    ListSkills,
    SkillsListed,
    "model",
    1_048_576,
    "all skills of the robot, and the one in use",
    askers=("station", "history"),
    looks=True,
)
CHOOSE_SKILL = Query(
    "model/choose_skill",
    ChooseSkill,
    Learnt,
    "model",
    20_480,
    "use another skill, or a new one",
    askers=("station", "history"),
)

QUERIES: tuple[Query[Any, Any], ...] = (
    ACQUIRE,
    ANSWER,
    REVOKE,
    RELEASE,
    EXECUTE,
    TELEOPERATE,
    FINISH,
    PACE,
    RESUME,
    RESET,
    RELEASE_STOP,
    PREDICT,
    PLAN,
    ADD_DEMONSTRATION,
    UNDO,
    REDO,
    HISTORY,
    COMPARE,
    DESCRIBE,
    SKILLS,
    CHOOSE_SKILL,
)
