"""One episode: an execution from the first motion to the verdict, and the account of it."""

from dataclasses import dataclass
from typing import Protocol

from lfd.motion.trajectory import Trajectory
from protocol.messages import Cut
from services.robot.correction import Correction
from services.robot.hold import LONG_HOLD_S
from services.robot.recording import NO_GRIPPER, Openings, Recording
from services.robot.verdict import Verdict
from sim.pose import Pose

SETTLE_S = 0.5
"""The arm arrives and a toppling object falls before the verdict is given [s]."""


class Course(Protocol):
    """What leads the arm through an episode: a prediction under correction, or a hand alone.

    Not calling `advance` is a hold: time stands still, the reference stays.

    Attributes:
        correction: of the operator's, as it is applied now.
    """

    correction: Correction

    @property
    def points(self) -> int:
        """Of the account of what was done."""
        ...

    @property
    def time(self) -> float:
        """Of the motion [s]."""
        ...

    @property
    def progress(self) -> float:
        """Share of the motion that lies behind."""
        ...

    @property
    def ramping(self) -> bool:
        """The motion's time stands still while the arm goes to where it left off."""
        ...

    @property
    def corrects(self) -> bool:
        """What the operator wants counts now."""
        ...

    @property
    def finished(self) -> bool:
        """The motion is at its end."""
        ...

    @property
    def nominal(self) -> Pose:
        """Where it should be without the operator's correction."""
        ...

    @property
    def reference(self) -> Pose:
        """Where the grasping frame should be now."""
        ...

    @property
    def opening(self) -> float | None:
        """How far the gripper should be open now [m]; None where it stays as it is."""
        ...

    def is_input(self, wanted: Correction) -> bool:
        """What is wanted is more than a device's noise."""
        ...

    def advance(self, wanted: Correction, leeway: float = 1.0, share: float = 1.0) -> Pose:
        """Go on by one control period as the operator wants; the reference at its end.

        Args:
            wanted: by the operator.
            leeway: see `Watchdog.leeway`.
            share: of its pace at which the joints let it go on.
        """
        ...

    def rejoin(self, measured: Pose, *, at_once: bool) -> None:
        """Go on after a hold, from the measured pose; at once where it was short and the arm did not leave."""
        ...


@dataclass(frozen=True, eq=False)
class EpisodeOutcome:
    """What became of an episode.

    Attributes:
        refined: the reference including the operator's correction, as many way-points, in real moved time.
        commanded: what the joints were told, as poses of the grasping frame.
        measured: what the arm did.
        verdict: at the end.
        cut: what cut it short; None where it ran to the prediction's end.
        reason: the same for people, empty where it did.
        operator_input: a correction of the operator's took part in it.
        clamped: control periods in which something was clamped.
        held: time spent holding [s].
        duration: from the first motion to the verdict [s].
        progress: share of the prediction that was executed.
        clear_until: share of it before anything was touched or kicked over; `progress` where nothing was.
    """

    refined: Trajectory
    commanded: Trajectory
    measured: Trajectory
    verdict: Verdict
    cut: Cut | None
    reason: str
    operator_input: bool
    clamped: int
    held: float
    duration: float
    progress: float
    clear_until: float

    @property
    def completed(self) -> bool:
        """It ran to its end."""
        return self.cut is None


class Episode:
    """Counts and records while an execution advances.

    Args:
        execution: that advances.
        period: of the control [s].
        grips: the gripper takes part, and the account says how far it was open.
    """

    def __init__(self, execution: Course, period: float, *, grips: bool = False) -> None:
        self.execution = execution
        self.recording = Recording(period, grips=grips)
        self.holding = False
        self._period = period
        self._cut: Cut | None = None
        self._reason = ""
        self._settled = 0
        self._ticks = 0
        self._held = 0
        self._held_since = 0
        self._standing: Pose | None = None
        self._clamped = 0
        self._input = False
        self._clear_until: float | None = None

    @property
    def settling(self) -> bool:
        """The reference stands still until the verdict."""
        return self._cut is not None or self.execution.finished

    @property
    def over(self) -> bool:
        """Time for the verdict."""
        return self._settled * self._period >= SETTLE_S

    def cut_short(self, cut: Cut, reason: str, measured: Pose) -> None:
        """Let the reference stand from now on; the verdict follows when the arm has settled.

        Args:
            cut: what cuts it short.
            reason: the same for people.
            measured: pose of the grasping frame now, where an arm that holds stays.
        """
        if not self.settling:
            self._cut, self._reason = cut, reason
            self._standing = measured if self.holding else self.execution.reference

    def hold(self) -> None:
        """Let a control period pass without going on; what is over settles all the same."""
        if not self.holding:
            self._held_since = self._ticks
        self.holding = True
        self._ticks += 1
        self._held += 1
        self._settled += self.settling

    def advance(self, wanted: Correction, measured: Pose, leeway: float = 1.0, share: float = 1.0) -> Pose:
        """Go on by one control period.

        Args:
            wanted: the correction that the operator asks for.
            measured: pose of the grasping frame, from where a hold is left.
            leeway: see `Watchdog.leeway`.
            share: of its pace at which the joints let the motion go on.

        Returns:
            The reference at the end of the period.
        """
        held, self.holding = self.holding, False
        self._ticks += 1
        if self.settling:
            self._settled += 1
            return self._standing or self.execution.reference
        if held:
            duration = (self._ticks - 1 - self._held_since) * self._period
            self.execution.rejoin(measured, at_once=duration <= LONG_HOLD_S)
        if self.execution.corrects:
            self._input |= self.execution.is_input(wanted)
        return self.execution.advance(wanted, leeway, share)

    def record(
        self, reference: Pose, commanded: Pose, measured: Pose, openings: Openings = NO_GRIPPER, *, clamped: bool
    ) -> None:
        """Keep what this period's command was and did."""
        self._clamped += clamped
        if not self.execution.ramping:
            self.recording.add(self.execution.time, (reference, commanded, measured), openings)

    def judged(self, verdict: Verdict) -> None:
        """Remember how far the motion was when something was first touched or kicked over."""
        if self._clear_until is None and (verdict.collision is not None or verdict.kicked_over):
            self._clear_until = self.execution.progress

    def outcome(
        self, verdict: Verdict, measured: Pose, stopped: str = "", openings: Openings = NO_GRIPPER
    ) -> EpisodeOutcome:
        """The account.

        Args:
            verdict: at the end.
            measured: pose of the grasping frame now.
            stopped: why the arm was stopped before its end, empty where it was not.
            openings: of the gripper now.
        """
        cut, reason = (Cut.STOPPED, stopped) if stopped else (self._cut, self._reason)
        motions = self.recording.motions(self.execution.points, measured, openings)
        progress = self.execution.progress
        return EpisodeOutcome(
            refined=motions.refined,
            commanded=motions.commanded,
            measured=motions.measured,
            verdict=verdict,
            cut=cut,
            reason=reason,
            operator_input=self._input,
            clamped=self._clamped,
            held=self._held * self._period,
            duration=self._ticks * self._period,
            progress=progress,
            clear_until=progress if self._clear_until is None else self._clear_until,
        )
