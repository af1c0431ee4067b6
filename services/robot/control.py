"""The robot without its transport: authority, emergency stop and watchdog around one arm.

Every method that carries out a request raises `Refusal` where it does not; times are the robot's monotonic clock.
"""

from collections.abc import Callable
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from protocol.messages import AuthorityEvent, Cut, MasterState, Mode, Phase, Prediction
from protocol.queries import AcquireAuthority, Adapt, Execute, Finish, Pace, ReleaseStop, Reset, Resume, Teleoperate
from services.bus.arrays import motion_from_wire
from services.bus.subscription import Received
from services.process.exceptions import ServiceError
from services.robot import wire
from services.robot.admission import admit_pace, admit_prediction, admit_reset, admit_target
from services.robot.arm import Arm
from services.robot.authority import NOBODY, Lease
from services.robot.backends.backend import CONTROL_PERIOD
from services.robot.contact import ContactPort
from services.robot.correction import UNCORRECTED, Correction
from services.robot.episode import EpisodeOutcome
from services.robot.execution import Execution, look_ahead
from services.robot.hand import Hand
from services.robot.hold import Hold
from services.robot.memory import Memory
from services.robot.order import Finished, Order
from services.robot.refusal import Refusal
from services.robot.safety import Watchdog
from services.robot.starts import StartImpossible
from services.robot.tick import Tick
from sim.tasks import AnyScene

Array = NDArray[np.float64]


class Control:
    """Decides in every control period whether the arm may move, and under whose correction.

    Args:
        arm: that it commands.
        scene: that the arm stands in.
        lease_s: how long the authority lasts without renewal [s].
        watchdog: that lets motions go on.
        master_gain: of the master's displacement on the reference; its rotation counts as it is.
        memory: where stop and epochs outlive the process.
        utc: the time of day.
    """

    def __init__(
        self,
        arm: Arm,
        scene: AnyScene,
        *,
        lease_s: float,
        watchdog: Watchdog,
        master_gain: float,
        memory: Memory,
        utc: Callable[[], datetime],
    ) -> None:
        self.arm = arm
        self.scene = scene
        self.memory = memory
        self._utc = utc
        recalled = memory.recall(self._now())
        self.latch = self._recalled = recalled.latch
        if self.latch.latched:
            arm.halt(str(self.latch))
        # The time of day is above every epoch of a robot whose file was lost.
        self.lease = Lease(lease_s, epoch=max(recalled.epoch_bound, round(1e3 * utc().timestamp())))
        self.order: Order | None = None
        self.finished: Finished | None = None
        self._watchdog = watchdog
        self._hold = Hold()
        self._hand = Hand(master_gain, arm)
        self.contact = ContactPort(CONTROL_PERIOD)
        self._place: Array = scene.training_positions[0]

    def acquire(self, request: AcquireAuthority, process: str, now_ns: int) -> int:
        """Give the authority to a holder for whom a process asks; the epoch."""
        self._check_stop()
        holder, who, over, why = request.holder, request.operator, request.take_over, request.reason
        return self.lease.acquire(holder, now_ns, operator=who, take_over=over, reason=why, process=process)

    def execute(self, request: Execute, predicted: Prediction | None) -> int:
        """Begin an episode; its number.

        Args:
            request: what to execute, and how.
            predicted: the prediction of the id that the request names; None where none was heard.
        """
        self._check(request.epoch)
        if predicted is None:
            raise Refusal(f"no prediction {request.prediction} was heard from the model: predict again")
        try:
            positions, orientations, _, opening = motion_from_wire(predicted.motion)
        except ServiceError as error:
            raise Refusal(f"the prediction cannot be executed: {error}") from error
        given = (positions, orientations, request.duration, self.arm.measured, predicted.waypoints)
        prediction = admit_prediction(*given, opening=opening)
        if predicted.waypoints:
            self.arm.check_reach(prediction, predicted.waypoints)
        after = look_ahead(prediction) if request.adapt is Adapt.NEXT else 0.0
        self.arm.begin(prediction, after, (request.part.first, request.part.last))
        return self._ordered(request, request.mode, request.prediction)

    def teleoperate(self, request: Teleoperate) -> int:
        """Begin an episode that the operator's hand leads; its number."""
        self._check(request.epoch)
        self.arm.teleoperate()
        return self._ordered(request, Mode.TEACH)

    def finish(self, request: Finish) -> None:
        """End the running episode here."""
        self.lease.check(request.epoch)
        if self.arm.episode is None:
            raise Refusal("no episode is running: nothing to finish")
        share = "" if self.mode is Mode.TEACH else f" at {self.arm.episode.execution.progress:.0%}"
        self.arm.finish(Cut.FINISHED, f"finished by {self.lease.who}{share}")

    def pace(self, request: Pace) -> None:
        """Let the motion that is under way go on at another pace, or back; what holds it holds it all the same."""
        self._check_stop()
        self.lease.check(request.epoch)
        episode = self.arm.episode
        if episode is None or episode.settling:
            raise Refusal("no motion is under way: there is no pace to change")
        if not isinstance(episode.execution, Execution):
            raise Refusal("the operator's hand leads this motion: it has no pace to change")
        admit_pace(episode.execution.prediction, request.rate)
        episode.execution.go(request.rate, request.until)

    def resume(self, request: Resume) -> None:
        """Let an episode go on that waits to be asked."""
        self._check_stop()
        self.lease.check(request.epoch)
        if not self.waiting:
            raise Refusal("no episode waits to be asked: nothing to go on with")
        self._hold.ask(request.epoch)

    def reset(self, request: Reset) -> None:
        """Put arm, target and scene back, or begin to."""
        self._check(request.epoch)
        variant = self.arm.variant if request.variant is None else request.variant
        place = self._place if (asked := admit_target(self.scene, request)) is None else asked
        start = None if request.start is None else wire.pose_of(request.start)
        admit_reset(self.scene, variant, place, start)
        try:
            self.arm.reset(place, variant, start)
        except StartImpossible as error:
            raise Refusal(f"{error}: give another start") from error
        self._hold.ask(request.epoch)
        self._place = place

    def press(self, by: str, reason: str) -> None:
        """Latch the emergency stop; the arm stands still at once. A press that is repeated changes nothing."""
        if not self.latch.latched:
            self.latch = self.latch.pressed(by, reason, self._now())
            self._end(self.arm.halt(str(self.latch)))

    def release_stop(self, request: ReleaseStop) -> None:
        """Release the latched stop; whoever held the authority has lost it."""
        if not self.latch.latched:
            raise Refusal("the emergency stop is not latched: nothing to release")
        if not request.by:
            raise Refusal("the release needs a name: say who releases the stop")
        self.arm.recover()
        self.latch = self.latch.released(request.by, self._now())
        self.lease.end(request.by)

    def tick(
        self, now_ns: int, sample: Received[MasterState] | None, given: Callable[[], None], way_s: float = 0.0
    ) -> Tick:
        """One control period.

        Args:
            now_ns: the time.
            sample: the newest master state under the authority, None where there was none.
            given: called when the arm's command has been handed over.
            way_s: how long the sample took to come, as far as that is known [s].
        """
        self.lease.expire(now_ns)
        self._end_another_s()
        reason = self._hold_reason(now_ns, sample, way_s)
        refined = self.arm.episode if self.mode is Mode.REFINE else None
        wanted = self.contact.limited(self._wanted(sample, reason), sample and sample.message, refined)
        tick = self.arm.tick(wanted, reason, given, self._leeway(now_ns, sample, way_s))
        self.contact.observe(tick.observation.contact_force)
        self._end(tick.outcome)
        if tick.fault:
            self.press("robot", tick.fault)
        # Only now, with the arm told to stand: a disk may take its time.
        self.memory.keep(self.latch, self.lease.epoch)
        return tick

    @property
    def waiting(self) -> bool:
        """An episode goes on only when it is asked to."""
        episode = self.arm.episode
        return episode is not None and not episode.settling and self._hold.waiting

    @property
    def latched_earlier(self) -> bool:
        """Stop and release are as they were when the process began: nobody has pressed or released since."""
        return self.latch is self._recalled and bool(self.latch.at)

    @property
    def mode(self) -> Mode:
        """Of the order that runs, or ran last."""
        return self.order.mode if self.order is not None else Mode.AUTONOMOUS

    def let_go(self) -> None:
        """The hand was off the master, if only for a moment."""
        self._hand.let_go()
        self.contact.let_go()

    @property
    def master_gain(self) -> float:
        """Of the master's displacement on the reference."""
        return self._hand.gain

    def phase(self, tick: Tick) -> Phase:
        """What the robot is doing, the emergency stop before all."""
        if self.latch.latched:
            return Phase.STOPPED
        return Phase.HOMING if self.arm.drive.goes_home else tick.phase

    def _ordered(self, request: Execute | Teleoperate, mode: Mode, prediction: int = 0) -> int:
        number = self.order.episode + 1 if self.order is not None else 1
        self.order = Order(number, request.request, mode, prediction, self.lease.holder, self.lease.who)
        self.finished = None
        self._hold.ask(request.epoch)
        self.let_go()
        return number

    def _hold_reason(self, now_ns: int, sample: Received[MasterState] | None, way_s: float) -> str:
        """Why a motion may not go on in this period; empty where it may."""
        cause = self._watchdog.presence(self.lease.holder, self.lease.silence_s(now_ns))
        if self.mode is not Mode.AUTONOMOUS and not (cause or self.arm.drive.goes_home):
            age_s = sample.age_s(now_ns) if sample is not None else None
            # Where the hand leads alone the robot stands without it, and nothing is left undone.
            free = self.mode is Mode.TEACH
            engaged = free or (sample is not None and sample.message.engaged)
            cause = self._watchdog.hand(age_s, engaged=engaged, way_s=way_s)
        return self._hold.reason(now_ns, cause, self.lease.epoch)

    def _leeway(self, now_ns: int, sample: Received[MasterState] | None, way_s: float) -> float:
        """See `Watchdog.leeway`."""
        absence_s = self.lease.silence_s(now_ns)
        if self.mode is Mode.AUTONOMOUS or sample is None:
            return self._watchdog.leeway(absence_s)
        return self._watchdog.leeway(absence_s, sample.age_s(now_ns), way_s)

    def _wanted(self, sample: Received[MasterState] | None, hold_reason: str) -> Correction:
        """What the operator asks for: a correction, or by how much to move where the hand leads alone."""
        episode = self.arm.episode
        if episode is None or self.mode is Mode.AUTONOMOUS or sample is None:
            return UNCORRECTED
        if self._hand.is_another(sample.message):
            self.let_go()
        leads = self.mode is Mode.TEACH
        return self._hand.asks(sample.message, episode.execution, leads=leads, holding=bool(hold_reason))

    def _end(self, outcome: EpisodeOutcome | None) -> None:
        if outcome is not None and self.order is not None:
            self.finished = Finished(self.order, outcome)

    def _end_another_s(self) -> None:
        """An episode does not go on under another holder than the one who asked for it."""
        lease, order = self.lease, self.order
        if order is None or lease.holder in (NOBODY, order.holder):
            return
        taken = lease.event is AuthorityEvent.TAKEN_OVER
        how = f"{lease.who} took the authority over from {order.who}" if taken else f"{lease.who} has the authority now"
        self.arm.finish(Cut.TAKEN_OVER, how)

    def _check(self, epoch: int) -> None:
        self._check_stop()
        self.lease.check(epoch)
        if self.arm.episode is not None:
            raise Refusal("an episode is running: wait for its end, or finish it")
        if self.arm.drive.goes_home:
            raise Refusal("the arm is on its way to the start: wait until it is there")

    def _check_stop(self) -> None:
        if self.latch.latched:
            raise Refusal(f"{self.latch}: release it first")

    def _now(self) -> str:
        return self._utc().isoformat(timespec="seconds")
