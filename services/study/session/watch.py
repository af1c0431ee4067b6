"""Watches the robot and the teaching: each attempt, what came of it, and for how long the operator could act.

One rule for all methods: time counts while the operator leads or corrects a motion that goes on. Replays, motions of
the robot alone, ramps, resets, settling, holds and thinking do not count; all of them are kept as raw times.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from protocol.messages import Attempt, Mode, Phase, RobotState, TeachingState
from protocol.topics import MODEL_STATE, ROBOT_STATE, TEACHING_STATE
from services.bus.bus import Bus
from services.offline.people.ways import Teaching
from services.study.events import Attempted

GAP_S = 0.1
"""Between two states of the robot that are heard, more is not counted: nobody knows what went on."""


@dataclass
class _Times:
    """Of one attempt, from the end of the one before [s]."""

    began: float
    raw: dict[str, float] = field(default_factory=lambda: dict.fromkeys(("acting", "holding", "alone", "other"), 0.0))

    @property
    def told(self) -> dict[str, float]:
        """As they are written down."""
        return {name: round(seconds, 3) for name, seconds in self.raw.items()}


class Watch:
    """Of one part of a participant's session.

    Attributes:
        attempts: so far.
        active: that the operator could act, all attempts together and what runs now [s].
        told: by the station, the newest; None before it says anything.
        acting: the operator can act now.
        updates: of the model, as it said last.
        lasted: since the part's begin, the interruptions of it left out [s].

    Args:
        bus: to robot and station.
        participant: number.
        part: name of the part.
        teaching: how the operator leads.
        known: attempts of this part that were told before.
        lasted: the part before this [s].
    """

    def __init__(
        self, bus: Bus, participant: int, part: str, teaching: Teaching, *, known: int = 0, lasted: float = 0.0
    ) -> None:
        self.attempts: list[Attempted] = []
        self.active = 0.0
        self.told: TeachingState | None = None
        self.acting = False
        self.updates = 0
        self.lasted = lasted
        self._participant = participant
        self._part = part
        self._teaching = teaching
        self._known = known
        self._robot = bus.subscribe(ROBOT_STATE)
        self._teachings = bus.subscribe(TEACHING_STATE)
        self._model = bus.subscribe(MODEL_STATE)
        self._first_ns: int | None = None
        self._before_ns = 0
        self._before = lasted
        self._times = _Times(lasted)
        self._station = 0
        self._newest: int | None = None

    @property
    def unfinished(self) -> dict[str, float]:
        """Times since the newest attempt has ended, by name [s]."""
        return self._times.told

    def step(self, now_ns: int) -> list[Attempted]:
        """Look; the attempts that have ended since."""
        if self._first_ns is None:
            self._first_ns = self._before_ns = now_ns
        robot = self._robot.fresh(now_ns)
        since = min((now_ns - self._before_ns) / 1e9, GAP_S)
        self._before_ns = now_ns
        self.lasted = self._before + (now_ns - self._first_ns) / 1e9
        doing = _doing(robot)
        self.acting = doing == "acting"
        self._times.raw[doing] += since
        self.active += since if self.acting else 0.0
        told = self._teachings.fresh(now_ns)
        if told is None:
            return []
        self.told = told
        if self._newest is None:  # what the station has from before this part is not of it
            self._newest = told.attempts[-1].number if told.attempts else 0
        elif told.publisher != self._station:  # one that was started again counts anew
            self._newest = 0
        self._station = told.publisher
        ended = [self._ended(one) for one in told.attempts if one.number > self._newest]
        if told.attempts:
            self._newest = told.attempts[-1].number
        model = self._model.latest()
        if model is not None:
            self.updates = model.message.updates
        return ended

    def _ended(self, one: Attempt) -> Attempted:
        """An attempt with its times; the next one's begin."""
        times, self._times = self._times, _Times(self.lasted)
        ended = Attempted(
            participant=self._participant,
            part=self._part,
            number=self._known + len(self.attempts) + 1,
            teaching=None if one.mode is Mode.AUTONOMOUS else self._teaching,
            updates=self.updates,
            success=one.verdict.success,
            reached=one.verdict.reached,
            kicked_over=one.verdict.kicked_over,
            collision=one.verdict.collision,
            active=round(times.raw["acting"], 3),
            began=round(times.began, 3),
            ended=round(self.lasted, 3),
            raw=times.told,
        )
        self.attempts.append(ended)
        return ended


def _doing(robot: RobotState | None) -> str:
    if robot is None:
        return "other"
    if robot.phase is Phase.HOLD:
        return "holding"
    if robot.phase is not Phase.EXECUTE:
        return "other"
    return "alone" if robot.mode is Mode.AUTONOMOUS else "acting"
