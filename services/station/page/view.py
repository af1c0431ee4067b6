"""What the operator's page shows: one frozen snapshot, and the board on which the newest one hangs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import msgspec

from protocol.messages import (
    Attendance,
    AuthorityState,
    ExecutionState,
    Light,
    MasterState,
    ModelState,
    ObjectPose,
    Prediction,
    Recording,
    RobotState,
    SafetyState,
    TeachingState,
    Vector3,
    Verdict,
)
from protocol.queries import SkillsListed
from services.bus.picture_stream import Group
from services.bus.stages import Stages
from services.process.clock import Clock
from services.process.load import Load, Loads, no_load
from services.station.live_view.drawing import Drawing
from services.station.neighbours import Neighbour

if TYPE_CHECKING:  # they are put into words as what is shown here is
    from services.station.page.entries import Rows

HOLD_SHOWN_NS = 600_000_000
"""For how long a hold that is over is still shown."""

LIMIT_SHOWN_NS = 1_000_000_000
"""For how long what was limited in one control period is still shown."""


@dataclass(frozen=True)
class Picture:
    """What a camera showed last.

    Attributes:
        data: as it came, or the points of a `PointCloud`; a new object means a new picture.
        age_s: since it was captured [s].
        yaw: by which the camera looks to the left of the base's x axis [rad].
        group: what it needs, itself included; None of a JPEG file and of points.
    """

    data: bytes
    age_s: float
    yaw: float = 0.0
    group: Group | None = None


@dataclass(frozen=True)
class PageView:
    """Everything that the page shows; None where it has never come.

    Attributes:
        robot_age_s: age of the robot's state [s]; infinite where there is none.
        prediction: of the model as it is now.
        history: of the model.
        skills: of the robot.
        execution: of the motion under way; None where there is none.
        spoilt: shares of the motion that is shown at which something was touched or kicked over.
        drawing: what the live view shows.
        force: that the operator feels [N].
        cameras: what each showed last, by its name.
        master: what the operator's device says of itself.
        authority_is_mine: this station holds the authority.
        neighbours: the other robots of the network.
        attendances: who is at which station's page.
        path: how long each stage takes from this operator's hand to the robot, and back to the eye.
        notice: one line about what went wrong last; empty where nothing did.
        open_network: others can listen in on the robot's network, and command on it.
        wide_open: of the gripper where it takes part [m]; 0 where it takes none.
        opening: that was asked of it here, as a share of wide open; None where nothing was.
    """

    teaching: TeachingState | None = None
    robot: RobotState | None = None
    robot_age_s: float = math.inf
    verdict: Verdict | None = None
    safety: SafetyState | None = None
    authority: AuthorityState | None = None
    authority_is_mine: bool = False
    neighbours: tuple[Neighbour, ...] = ()
    attendances: tuple[Attendance, ...] = ()
    model: ModelState | None = None
    prediction: Prediction | None = None
    history: Rows | None = None
    skills: SkillsListed | None = None
    object_pose: ObjectPose | None = None
    execution: ExecutionState | None = None
    spoilt: tuple[float, ...] = ()
    drawing: Drawing = field(default_factory=Drawing)
    force: Vector3 = (0.0, 0.0, 0.0)
    master: MasterState | None = None
    recording: Recording | None = None
    cameras: Mapping[str, Picture | None] = field(default_factory=dict)
    cloud: Picture | None = None
    path: Stages = field(default_factory=Stages)
    notice: str = ""
    open_network: bool = False
    wide_open: float = 0.0
    opening: float | None = None


@dataclass(frozen=True)
class Shown:
    """A view as the page shows it.

    Attributes:
        view: the newest.
        elapsed_s: since it was put up [s]: everything in it has aged by as much.
        clamped: what the robot limited in the last moment, each a short word with the place.
        load: of this computer; None where that is not known.
    """

    view: PageView
    elapsed_s: float
    clamped: tuple[str, ...] = ()
    load: Load | None = None

    @property
    def robot_age_s(self) -> float:
        """Age of the robot's state now [s]."""
        return self.view.robot_age_s + self.elapsed_s


class Board:
    """Where the service's thread hangs the newest view and the page's thread reads it.

    A hold that comes and goes, and what was limited, are shown for a moment longer, so that they can be read.

    Args:
        clock: by which views age.
        load: says the load of this computer.
    """

    def __init__(self, clock: Clock, load: Loads = no_load) -> None:
        self._clock = clock
        self._load = load
        self._newest = (PageView(), clock.now_ns())
        self._clamped: tuple[tuple[str, ...], int] = ((), 0)
        self._held: tuple[TeachingState, int] | None = None

    def put(self, view: PageView) -> None:
        """Replace the view; one assignment, so that no reader sees half of it."""
        now_ns = self._clock.now_ns()
        if view.robot is not None and view.robot.clamped:
            self._clamped = (view.robot.clamped, now_ns)
        steady = self._steady(view.teaching, now_ns)
        self._newest = (view if steady is view.teaching else replace(view, teaching=steady), now_ns)

    def newest(self) -> Shown:
        """The newest view and its age."""
        (view, put_ns), (clamped, clamped_ns) = self._newest, self._clamped
        now_ns = self._clock.now_ns()
        limits = clamped if now_ns - clamped_ns < LIMIT_SHOWN_NS else ()
        return Shown(view, (now_ns - put_ns) / 1e9, limits, self._load())

    def _steady(self, teaching: TeachingState | None, now_ns: int) -> TeachingState | None:
        if teaching is None:
            return None
        if teaching.light is Light.HOLD:
            self._held = (teaching, now_ns)
        elif self._held is not None and self._outlasts(self._held, teaching, now_ns):
            return msgspec.structs.replace(teaching, light=Light.HOLD, text=self._held[0].text)
        return teaching

    @staticmethod
    def _outlasts(held: tuple[TeachingState, int], teaching: TeachingState, now_ns: int) -> bool:
        before, held_ns = held
        return before.phase == teaching.phase and teaching.light is Light.GREEN and now_ns - held_ns < HOLD_SHOWN_NS
