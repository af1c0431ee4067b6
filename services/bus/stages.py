"""How long each stage of an operator's own path takes: from the hand to the robot, and back to the eye.

What was measured stands in the messages; here it comes together, the same for page, recording and benchmark. A stage
that nobody can know is None, and never counted as nothing.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import astuple, dataclass, fields

from protocol.messages import Figure, MasterState, OperatorInput, RobotState

_FIGURE = "stage_"

LASTING_NS = 5_000_000_000
"""For so long what was measured is shown: a key is not pressed all the time, nor does an arm always move."""

LONGEST_S = 60.0
"""What took longer was no stage of anything: a picture of before a sleep, a number that somebody made up."""


@dataclass(frozen=True)
class Stages:
    """Durations [s].

    Attributes:
        capture: from the key or device, as the browser reads it, to the master's sample.
        way: from there until the robot has it.
        apply: until the arm was handed the command that the sample shaped.
        motion: until the arm was measured where the command says.
        picture: from a picture's capture until it was drawn in the browser.
    """

    capture: float | None = None
    way: float | None = None
    apply: float | None = None
    motion: float | None = None
    picture: float | None = None

    @property
    def known(self) -> tuple[float, ...]:
        """Those that are known, in their order."""
        return tuple(value for value in astuple(self) if value is not None)

    @property
    def total(self) -> float:
        """Of those that are known: no more than from hand to eye."""
        return sum(self.known)

    @property
    def complete(self) -> bool:
        """Whether all are known."""
        return len(self.known) == len(NAMES)

    def figures(self) -> tuple[Figure, ...]:
        """Those that are known, as a process tells them in its heartbeat."""
        return tuple(Figure(_FIGURE + name, 1e3 * value, "ms") for name, value in _named(self) if value is not None)


NAMES = tuple(field.name for field in fields(Stages))


class Lasting:
    """The newest that is known of each stage: what is measured only now and then stays known for a while."""

    def __init__(self) -> None:
        self._known: dict[str, tuple[float, int]] = {}

    def see(self, known: Stages, now_ns: int) -> None:
        """Remember what is known now [ns]."""
        self._known |= {name: (value, now_ns) for name, value in _named(known) if value is not None}

    def forget(self) -> None:
        """It was another's."""
        self._known.clear()

    def at(self, now_ns: int) -> Stages:
        """What was known within the last `LASTING_NS` [ns]."""
        return Stages(**{name: value for name, (value, at_ns) in self._known.items() if now_ns - at_ns <= LASTING_NS})


def merged(parts: Iterable[Stages]) -> Stages:
    """One way of what several processes know of it."""
    return Stages(**{name: value for part in parts for name, value in _named(part) if value is not None})


def _named(known: Stages) -> Iterable[tuple[str, float | None]]:
    return zip(NAMES, astuple(known), strict=True)


def stages(
    operator: OperatorInput | None = None, master: MasterState | None = None, robot: RobotState | None = None
) -> Stages:
    """What the newest messages of one path say."""
    return Stages(
        capture=_known(master.capture) if master is not None else None,
        way=_known(robot.applied_way) if robot is not None else None,
        apply=_known(robot.applied_latency - robot.applied_way) if robot is not None and _way_is_known(robot) else None,
        motion=_known(robot.following_lag) if robot is not None else None,
        picture=_known(operator.drawn) if operator is not None else None,
    )


def from_figures(figures: Iterable[Figure]) -> Stages:
    """What heartbeats say; of a stage that several tell, the last."""
    told = {
        figure.name.removeprefix(_FIGURE): figure.value / 1e3
        for figure in figures
        if figure.name.startswith(_FIGURE) and figure.name.removeprefix(_FIGURE) in NAMES
    }
    return Stages(**told)


def _way_is_known(robot: RobotState) -> bool:
    return 0.0 <= robot.applied_way <= robot.applied_latency


def _known(value: float) -> float | None:
    return value if 0.0 <= value <= LONGEST_S else None
