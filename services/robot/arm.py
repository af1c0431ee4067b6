"""The arm: one command in every control period, whatever happens around it.

The service and the offline rollout both drive this class; here execution, kinematics, limits, backend and verdict meet.
"""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from lfd.motion.part import WHOLE, Part
from lfd.motion.trajectory import Trajectory
from protocol.messages import Cut
from services.robot import safety
from services.robot.backends.backend import CONTROL_PERIOD, Backend, NotReady
from services.robot.correction import UNCORRECTED, Correction
from services.robot.drive import Drive
from services.robot.episode import Episode, EpisodeOutcome
from services.robot.execution import Execution
from services.robot.fingers import Fingers
from services.robot.joints import Joints, combined
from services.robot.mechanism import Mechanism
from services.robot.reach import check_reach
from services.robot.refusal import Refusal
from services.robot.starts import Starts
from services.robot.teleoperation import Teleoperation
from services.robot.tick import Tick, phase_of
from services.robot.verdict import Criteria, Verdict
from sim.pose import Pose

Array = NDArray[np.float64]


class Arm:
    """Drives one backend.

    Args:
        backend: what moves.
        kinematics: of it.
        criteria: by what episodes are judged.
        starts: where episodes can start; at first they do at its home.
        velocity_scale: share of the joints' speed limits that may be used.
        self_distance_stop: distance between the robot's parts at which it stops [m].
        wide_open: opening of the gripper [m]; 0 where there is none.
        grips: the gripper takes part in the task: what is told of a motion says how far it was open.
    """

    def __init__(
        self,
        backend: Backend,
        kinematics: Mechanism,
        criteria: Criteria,
        starts: Starts,
        *,
        velocity_scale: float = 0.5,
        self_distance_stop: float = 0.005,
        wide_open: float = 0.0,
        grips: bool = False,
    ) -> None:
        self._backend = backend
        self.drive = Drive(backend)
        self._kinematics = kinematics
        self._criteria = criteria
        self._starts = starts
        self.start = starts.home
        self.observation = self.drive.observe()
        self._joints = Joints(
            backend.joint_names,
            kinematics,
            combined(kinematics, backend.limits, velocity_scale),
            self.observation.q,
            velocity_scale=velocity_scale,
            self_distance_stop=self_distance_stop,
        )
        self._episode: Episode | None = None
        self._grips = grips
        self.fingers = Fingers(wide_open, self.observation.opening)
        self._stand()

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Of every joint vector."""
        return self._backend.joint_names

    @property
    def variant(self) -> str:
        """Which arrangement of the scene stands around the robot."""
        return self._backend.variant

    @property
    def condition(self) -> Array:
        """The external state that motions depend on here, shape (c,); empty where it is the object's."""
        return self.observation.condition

    @property
    def episode(self) -> Episode | None:
        """The one that runs."""
        return self._episode

    def reset(self, place: Array, variant: str, start: Pose | None = None) -> None:
        """Back to the start, the target and the scene put in place once it is there; see `Drive.reset`.

        Args:
            place: of the target, see `Backend.reset`, shape (d,) [m].
            variant: arrangement of the scene.
            start: pose of the grasping frame; as it was by default.

        Raises:
            StartImpossible: no motion can start there; nothing has changed.
        """
        start = self.start if start is None else start
        self.drive.reset(start, place, variant, self._starts.joints(start), lambda: self._begin_at(start))

    def _begin_at(self, start: Pose) -> None:
        self.start = start
        self._episode = None
        self.fingers.tell(self.fingers.wide_open)
        self._stand()

    def followed(self, wanted: Correction) -> Correction:
        """What the arm follows of a correction, its reach included."""
        return safety.clamp_correction(self._kinematics.admitted(wanted))[0]

    def check_reach(self, prediction: Trajectory, waypoints: Sequence[float]) -> None:
        """Let a motion pass that the arm can follow from where it stands; see `check_reach`."""
        check_reach(self._kinematics, self.observation.q, prediction, waypoints)

    def begin(self, prediction: Trajectory, look_ahead: float, part: Part = WHOLE) -> None:
        """Begin an episode, with a ramp from the measured pose to the prediction's start.

        Args:
            prediction: to execute, in the base frame.
            look_ahead: after which the correction is to equal the operator's [s].
            part: of the prediction in which the operator's correction counts.
        """
        self._stand()
        execution = Execution(self.measured, prediction, look_ahead, CONTROL_PERIOD, part, inert=self._joints.inert)
        self._episode = Episode(execution, CONTROL_PERIOD, grips=self._grips)

    def teleoperate(self) -> None:
        """Begin an episode that the operator's hand leads, from where the arm is."""
        self._stand()
        led = Teleoperation(lambda: self.measured, CONTROL_PERIOD)
        self._episode = Episode(led, CONTROL_PERIOD, grips=self._grips)

    def finish(self, cut: Cut, reason: str) -> None:
        """Let the running episode end here; its outcome follows when the arm has settled."""
        if self._episode is not None:
            self._episode.cut_short(cut, reason, self.measured)

    def stop(self, reason: str = "") -> EpisodeOutcome | None:
        """Stand still: at once where the arm is measured to be, or as a motion that has come to its end does.

        The gripper keeps what it holds.

        Args:
            reason: why the episode did not come to its end, empty where it did.

        Returns:
            The outcome of the episode that ran.
        """
        episode, self._episode = self._episode, None
        if reason or episode is None:
            self._joints.stand(self.observation.q)
        else:
            self._joints.end(self.observation.q)
        return episode.outcome(self._verdict, self.measured, reason, self.fingers.now) if episode is not None else None

    def halt(self, reason: str) -> EpisodeOutcome | None:
        """Stop, and command nothing until `recover`; see `stop`."""
        self.drive.stop(reason)
        return self.stop(reason)

    def recover(self) -> None:
        """Command again after a halt, from where the arm is.

        Raises:
            Refusal: see `Backend.recover`.
        """
        try:
            self.drive.recover()
        except NotReady as error:
            raise Refusal(f"{error}: see to it at the robot") from error
        self._stand()

    def tick(
        self,
        wanted: Correction,
        hold_reason: str = "",
        given: Callable[[], None] = lambda: None,
        leeway: float = 1.0,
    ) -> Tick:
        """Give one command and see what it did.

        Args:
            wanted: the correction that the operator asks for, or by how much a hand moves the gripper that leads alone.
            hold_reason: why a running episode may not go on, empty where it may.
            given: called when the command has been handed over, before the period passes in which it acts.
            leeway: see `Watchdog.leeway`.
        """
        episode = self._episode
        holding = bool(episode is not None and hold_reason)
        clamped: tuple[str, ...] = ()
        fault = ""
        try:
            before = self._joints.q
            clamped = self._decide(episode, wanted, leeway, holding=holding)
            q = self._joints.q
            qd, held = (q - before) / CONTROL_PERIOD, bool(hold_reason)
            told = self.drive.period(q, qd, self.fingers.told, given, held=held)
            if told is not q:
                self._joints.stand(told)  # another leads them, to where motions start
            self._observe()
        except Exception as error:  # noqa: BLE001 (whatever hardware and solvers raise: the arm stands and says so)
            fault = self.drive.fault(error)
        outcome = None
        if episode is not None:
            episode.judged(self._verdict)
            if not (holding or fault):
                commanded = self._kinematics.forward(self._joints.q)
                episode.record(
                    self._reference,
                    commanded,
                    self.measured,
                    self.fingers.now,
                    clamped=bool(clamped),
                )
            outcome = self.stop(fault) if fault else self._conclude(episode)
        return Tick(
            observation=self.observation,
            measured=self.measured,
            reference=self._reference,
            opening_reference=self.fingers.told,
            phase=phase_of(episode, holding=holding),
            progress=episode.execution.progress if episode is not None else 0.0,
            correction=episode.execution.correction if episode is not None else UNCORRECTED,
            hold_reason=hold_reason if holding else "",
            clamped=clamped,
            self_distance=self._joints.self_distance,
            verdict=self._verdict,
            outcome=outcome,
            fault=fault,
        )

    def _decide(self, episode: Episode | None, wanted: Correction, leeway: float, *, holding: bool) -> tuple[str, ...]:
        """Choose the next command; what was clamped."""
        if episode is None:
            self._joints.rest()
            return ()
        if not holding:
            return self._follow(episode, wanted, leeway)
        self._joints.hold(self.observation.q, begins=not episode.holding)
        episode.hold()
        return ()

    def _follow(self, episode: Episode, wanted: Correction, leeway: float) -> tuple[str, ...]:
        """Command the next reference; what was clamped."""
        within, too_far = safety.clamp_correction(self._kinematics.admitted(wanted))
        if episode.holding:
            self._joints.resume(self.observation.q)
            self._reference = self.measured
        # A hand is on a leash; only what the arm is near to slows it down.
        share = self._joints.near if isinstance(episode.execution, Teleoperation) else self._joints.share
        reference = episode.advance(within, self.measured, leeway, share)
        self.fingers.tell(episode.execution.opening)
        self._reference, too_fast = safety.clamp_reference(self._reference, reference, CONTROL_PERIOD)
        return (*too_far, *too_fast, *self._joints.follow(self._reference))

    def _conclude(self, episode: Episode) -> EpisodeOutcome | None:
        touch = self.observation.touch
        fault = self._joints.fault
        if touch is not None and safety.too_forceful(touch.force):
            fault = f"{touch.between[0]} pressed against {touch.between[1]} with {touch.force:.0f} N"
        if fault:
            x, y, z = self.measured.position
            return self.stop(f"{fault}, with the gripper at ({x:.2f}, {y:.2f}, {z:.2f}) m")
        return self.stop() if episode.over else None

    def _stand(self) -> None:
        """Start afresh from what is measured."""
        self.observation = self.drive.observe()
        self._joints.stand(self.observation.q)
        self._judge, self._began = self._criteria.begin(self.observation), self.observation.time
        self._observe()
        self._reference = self.measured

    def _observe(self) -> None:
        self.observation = seen = self.drive.observe()
        self.fingers.measured = seen.opening
        self.measured = self._kinematics.forward(seen.q)
        told, time = (self.measured, seen.object_pose, seen.touch), seen.time - self._began
        self._verdict: Verdict = self._judge.judge(*told, grasped=seen.grasped, time=time)
