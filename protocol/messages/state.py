"""What the robot and its scene are doing: the class `state`."""

from __future__ import annotations

import enum
from typing import Annotated

import msgspec

from protocol.messages.values import (
    Array,
    Count,
    Duration,
    Fraction,
    Joints,
    Message,
    Motion,
    Name,
    Opening,
    Part,
    Pose,
    Real,
    Text,
    Vector3,
)


class Phase(enum.Enum):
    """What the robot is doing."""

    IDLE = "idle"
    RAMP = "ramp"
    EXECUTE = "execute"
    HOLD = "hold"
    HOMING = "homing"
    STOPPED = "stopped"

    @property
    def running(self) -> bool:
        """An episode is under way: the robot moves, or holds and may go on."""
        return self in (Phase.RAMP, Phase.EXECUTE, Phase.HOLD)


class Mode(enum.Enum):
    """Who shapes the motion: the prediction alone, the operator on top of it, or the operator's hand alone."""

    AUTONOMOUS = "autonomous"
    REFINE = "refine"
    TEACH = "teach"


class Cut(enum.Enum):
    """What cut an episode short: its operator's Finish, another holder of the authority, a stop or a fault."""

    FINISHED = "finished"
    TAKEN_OVER = "taken_over"
    STOPPED = "stopped"


class RobotState(Message, frozen=True, kw_only=True):
    """The robot as measured, beside what it was told.

    Attributes:
        joint_names: of `q` and `qd`.
        q: measured joint positions [rad, torso m].
        qd: measured joint velocities [rad/s, torso m/s].
        measured: pose of the grasping frame, from `q`.
        reference: pose that the controller was told to reach in this period.
        phase: what the robot is doing.
        mode: of the episode that runs, or of the last one.
        episode: its number since the robot process started; 0 before the first.
        progress: of the episode, from 0 to 1.
        offset: the correction of the position as it is applied now, base axes [m].
        master_gain: of the master's displacement on `offset`.
        turn: the correction of the orientation as it is applied now, rotation vector in base axes [rad]; the
            reference's orientation is the predicted one, then rotated by it.
        hold_reason: why the robot holds, empty where it does not.
        waiting: it has held for so long that it goes on only when it is asked to (`cmd/resume`).
        clamped: what was clamped in this period, each a short word with the place.
        applied_sequence: of the last master state that took effect.
        applied_latency: from that sample's stamp to when the arm was handed the command that it shaped [s]; negative
            where the clocks are not comparable.
        contact_force: of the environment on the robot, low-passed and bounded, base axes [N]; zero where none is known.
        contact_energy: that contact did to the correction, since the process started [J]; see `lfd.passivity`.
        applied_way: the part of it before the robot heard of that sample [s]; negative where it is not known.
        following_lag: from when the arm was handed a command until it was measured to be there, as its motion of the
            last moment tells [s]; negative where it stood.
        ahead: by how much the robot's clock is ahead of that of the machine of the master that commands, as round trips
            tell [s]; None where they do not yet.
        opening: measured, between the gripper's fingers [m]; 0 where there is no gripper.
        opening_reference: that the gripper was told to go to in this period [m].
        grasped: both of its fingers touch the object.
    """

    joint_names: Annotated[tuple[Name, ...], msgspec.Meta(max_length=64)] = ()
    q: Joints = ()
    qd: Joints = ()
    measured: Pose
    reference: Pose
    phase: Phase
    mode: Mode = Mode.AUTONOMOUS
    episode: Count = 0
    progress: Real = 0.0
    offset: Vector3 = (0.0, 0.0, 0.0)
    master_gain: Annotated[float, msgspec.Meta(gt=0.0, le=1e3)] = 1.0
    turn: Vector3 = (0.0, 0.0, 0.0)
    hold_reason: Text = ""
    waiting: bool = False
    clamped: Annotated[tuple[Name, ...], msgspec.Meta(max_length=16)] = ()
    applied_sequence: Count = 0
    applied_latency: Real = -1.0
    contact_force: Vector3 = (0.0, 0.0, 0.0)
    contact_energy: Annotated[float, msgspec.Meta(ge=0.0, le=1e9)] = 0.0
    applied_way: Real = -1.0
    following_lag: Real = -1.0
    ahead: Real | None = None
    opening: Opening = 0.0
    opening_reference: Opening = 0.0
    grasped: bool = False


class WorldState(Message, frozen=True, kw_only=True):
    """The simulated world's generalised positions, for whoever draws it, and the truth about the object.

    Attributes:
        time: simulated [s].
        qpos: shape (nq,), MuJoCo's order.
        object_pose: the true pose in the base frame.
    """

    time: Real
    qpos: Array
    object_pose: Pose


class Unmet(enum.Enum):
    """What a task asks for beside reaching its target, and is not so."""

    GRASPED = "grasped"
    LIFTED = "lifted"
    PLACED = "placed"
    IN_TIME = "in_time"


class Verdict(Message, frozen=True, kw_only=True):
    """The success criteria (thesis, Appendix E), judged now; a collision stays until the next episode.

    Attributes:
        reached: the object's centre lies in the gripper's ellipsoid, or all via-points were passed through; and nothing
            else that the task asks for is unmet.
        kicked_over: the object moved further than its threshold on some axis, or has toppled.
        collision: the robot touched the environment.
        collision_position: where first, base frame [m].
        collision_force: normal force of the first contact [N].
        collision_between: the robot's link and the thing that it touched first.
        ellipsoid_value: of eq. E.1, or the greatest (error / tolerance)^2 at a via-point; at most 1 where reached.
        object_displacement: since the episode started [m].
        object_tilt: angle between the object's upright axis and the vertical [rad].
        missed: distance from the grasping frame to the object's centre, or the greatest at a via-point [m]; negative
            where it is not told.
        unmet: what else the task asks for and is not so.
    """

    reached: bool
    kicked_over: bool
    collision: bool
    collision_position: Vector3 | None = None
    collision_force: Real = 0.0
    collision_between: tuple[Name, Name] | None = None
    ellipsoid_value: Real = 0.0
    object_displacement: Vector3 = (0.0, 0.0, 0.0)
    object_tilt: Real = 0.0
    missed: Real = -1.0
    unmet: Annotated[tuple[Unmet, ...], msgspec.Meta(max_length=len(Unmet))] = ()


class ExecutionState(Message, frozen=True, kw_only=True):
    """The motion under way, for whoever looks on or corrects it.

    Attributes:
        episode: its number.
        mode: who shapes it.
        prediction: id of what was asked for; 0 where the operator's hand leads alone.
        progress: from 0 to 1.
        pace: as it was asked for: 1 is the motion's own, 0 a pause, a negative one goes back along it.
        part: of the motion in which corrections count.
        duration: that the whole motion takes at its own pace [s].
        look_ahead: time constant with which a correction follows the operator, and returns to nothing where nobody asks
            for it, in the motion's time [s]; 0 where it does so at once.
    """

    episode: Count
    mode: Mode
    prediction: Count
    progress: Real
    pace: Real = 1.0
    part: Part = Part()
    duration: Duration = 1.0
    look_ahead: Real = 0.0


class EpisodeResult(Message, frozen=True, kw_only=True):
    """What became of an episode; repeated until the next one starts.

    Attributes:
        episode: its number.
        request: the number that the asker gave it.
        mode: who shaped it.
        completed: it ran to its end and was not cut short.
        reason: why not, empty where it was.
        prediction: id of what was asked for; 0 where the operator's hand led alone.
        refined: the reference including the operator's correction.
        commanded: what the joints were told, as a motion of the grasping frame.
        measured: what the arm did.
        verdict: at its end.
        operator_input: the operator displaced or rotated the master at some time.
        clamped: ticks in which something was clamped.
        held: time spent holding [s].
        duration: from the first motion to the verdict [s].
        cut: what cut it short; None where it completed.
        progress: share of the prediction that was executed, or of the longest time that a hand may lead; the three
            motions are as far as it.
        clear_until: share of the prediction before anything was touched or kicked over; `progress` where nothing was.
    """

    episode: Count
    request: Count
    mode: Mode
    completed: bool
    reason: Text
    prediction: Count
    refined: Motion
    commanded: Motion
    measured: Motion
    verdict: Verdict
    operator_input: bool
    clamped: Count
    held: Real
    duration: Real
    cut: Cut | None = None
    progress: Fraction = 1.0
    clear_until: Fraction = 1.0


class ObjectPose(Message, frozen=True, kw_only=True):
    """The object as seen by a camera.

    Attributes:
        pose: of the object's centre in the base frame.
        tag: the marker's id.
        error: distance to the true position [m]; negative where there is no truth to compare with.
        rejected: pose flips filtered since the start.
        pictures: how many pictures the filtered pose rests on.
    """

    pose: Pose
    tag: Count
    error: Real = -1.0
    rejected: Count = 0
    pictures: Count = 0
