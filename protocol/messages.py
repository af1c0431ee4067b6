"""The messages: frozen structs that travel as MessagePack maps.

Units are SI, angles radians, frames stand in the field's name (`base` where nothing else is said), quaternions are
scalar first (w, x, y, z). A new field needs a default; any other change to a message needs the next `@v` in the key.
Numbers are bounded, so that a NaN or an infinity never passes the codec.
"""

from __future__ import annotations

import enum
import math
from typing import Annotated

import msgspec

Real = Annotated[float, msgspec.Meta(ge=-1e9, le=1e9)]
Vector3 = tuple[Real, Real, Real]
Quaternion = tuple[Real, Real, Real, Real]
Text = Annotated[str, msgspec.Meta(max_length=4096)]
Name = Annotated[str, msgspec.Meta(max_length=64)]
Count = Annotated[int, msgspec.Meta(ge=0, le=2**53)]
Joints = Annotated[tuple[Real, ...], msgspec.Meta(max_length=64)]
Condition = Annotated[tuple[Real, ...], msgspec.Meta(max_length=64)]

ITEM_SIZES = {"<f8": 8, "<f4": 4, "|u1": 1}
"""The array element types that may cross the wire: NumPy's names, little endian, to bytes an element."""


class Array(msgspec.Struct, frozen=True):
    """An n-dimensional array: element type, shape and raw bytes in C order.

    Raises:
        ValueError: on construction, where type, shape and length do not fit together.
    """

    dtype: Name
    shape: Annotated[tuple[Count, ...], msgspec.Meta(max_length=4)]
    data: bytes

    def __post_init__(self) -> None:
        item = ITEM_SIZES.get(self.dtype)
        if item is None:
            raise ValueError(f"dtype {self.dtype!r} is not one of {sorted(ITEM_SIZES)}")
        expected = math.prod(self.shape) * item
        if len(self.data) != expected:
            raise ValueError(f"{len(self.data)} bytes for shape {self.shape} of {self.dtype}, not {expected}")


class Pose(msgspec.Struct, frozen=True):
    """A position [m] and a unit quaternion."""

    position: Vector3
    orientation: Quaternion

    def __post_init__(self) -> None:
        norm = math.sqrt(sum(c * c for c in self.orientation))
        if abs(norm - 1.0) > 1e-3:
            raise ValueError(f"orientation has norm {norm:.6g}, not 1")


class Motion(msgspec.Struct, frozen=True):
    """A trajectory of the grasping frame in the base frame, uniform in time.

    Attributes:
        positions: shape (n, 3) [m].
        orientations: shape (n, 4), unit quaternions.
        duration: from the first sample to the last [s].
    """

    positions: Array
    orientations: Array
    duration: Annotated[float, msgspec.Meta(gt=0.0, le=3600.0)]

    def __post_init__(self) -> None:
        n = self.positions.shape[0] if self.positions.shape else 0
        if not 2 <= n <= 10_000 or self.positions.shape != (n, 3) or self.orientations.shape != (n, 4):
            raise ValueError(
                f"positions {self.positions.shape} and orientations {self.orientations.shape} are not (n, 3) and (n, 4)"
            )
        if self.positions.dtype != "<f8" or self.orientations.dtype != "<f8":
            raise ValueError("a motion's arrays are '<f8'")


class Message(msgspec.Struct, frozen=True, kw_only=True):
    """What every message on a topic carries; the bus fills it in.

    Attributes:
        publisher: the sender's incarnation: the upper 16 bits name its machine since boot, the rest is random.
        sequence: counts the publisher's messages on this topic, from 1.
        stamp_ns: the sender's monotonic clock [ns].
    """

    publisher: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0
    sequence: Count = 0
    stamp_ns: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0


# --- operator to robot -------------------------------------------------------------------------------------------


class OperatorInput(Message, frozen=True, kw_only=True):
    """The FULL state of the operator's page inputs, never a change of it.

    Attributes:
        keys: the physical keys held down, by their `KeyboardEvent.code`.
        focused: the page has the focus; without it no key counts.
        axes: gamepad or pointer axes, each from -1 to 1.
    """

    keys: Annotated[tuple[Name, ...], msgspec.Meta(max_length=32)] = ()
    focused: bool = False
    axes: Annotated[tuple[Real, ...], msgspec.Meta(max_length=16)] = ()


class MasterState(Message, frozen=True, kw_only=True):
    """The full state of the master device.

    Attributes:
        displacement: from the device's neutral position, in base axes [m].
        velocity: of the displacement [m/s].
        rotation: from the device's neutral orientation, rotation vector in base axes [rad].
        force: what the device renders to the hand (eq. 14) [N].
        engaged: a hand is on the device and the clutch is closed; displacement and rotation count only then.
        epoch: of the authority under which the master commands.
        device: what kind of device this is.
    """

    displacement: Vector3 = (0.0, 0.0, 0.0)
    velocity: Vector3 = (0.0, 0.0, 0.0)
    rotation: Vector3 = (0.0, 0.0, 0.0)
    force: Vector3 = (0.0, 0.0, 0.0)
    engaged: bool = False
    epoch: Count = 0
    device: Name = ""


class AuthorityRenewal(Message, frozen=True, kw_only=True):
    """The holder's sign of life; without it the lease runs out."""

    holder: Name
    epoch: Count


class EmergencyStop(Message, frozen=True, kw_only=True):
    """Pressed: every robot process that hears it latches a stop. Repeated while pressed."""

    pressed: bool
    by: Name
    reason: Text = ""


# --- robot to everybody ------------------------------------------------------------------------------------------


class Phase(enum.Enum):
    """What the robot is doing."""

    IDLE = "idle"
    RAMP = "ramp"
    EXECUTE = "execute"
    HOLD = "hold"
    STOPPED = "stopped"


class Mode(enum.Enum):
    """Who shapes the motion: the prediction alone, or the operator on top of it."""

    AUTONOMOUS = "autonomous"
    REFINE = "refine"


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
        turn: the correction of the orientation as it is applied now, rotation vector in base axes [rad]; the
            reference's orientation is the predicted one, then rotated by it.
        hold_reason: why the robot holds, empty where it does not.
        clamped: what was clamped in this period, each a short word with the place.
        applied_sequence: of the last master state that took effect.
        applied_latency: from that sample's stamp to its effect [s]; negative where the clocks are not comparable.
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
    turn: Vector3 = (0.0, 0.0, 0.0)
    hold_reason: Text = ""
    clamped: Annotated[tuple[Text, ...], msgspec.Meta(max_length=16)] = ()
    applied_sequence: Count = 0
    applied_latency: Real = -1.0


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


class Box(msgspec.Struct, frozen=True):
    """A box of the scene, in the base frame; half sizes [m], colour with alpha from 0 to 1."""

    name: Name
    centre: Vector3
    half_sizes: Vector3
    orientation: Quaternion
    rgba: tuple[Real, Real, Real, Real]


class SceneState(Message, frozen=True, kw_only=True):
    """The scene that the robot stands in and by what it judges success (thesis, Appendix E).

    Attributes:
        name: of the scene.
        variant: which of the scene's arrangements stands there now.
        variants: all of them, the one that the model was trained in first.
        boxes: the environment, to draw.
        object_size: full edge lengths [m]; zero where there is no object.
        ellipsoid_radii: of the reached ellipsoid about the grasping frame [m].
        kicked_over_thresholds: largest displacement on each axis [m].
        start: pose of the grasping frame from which the next motion starts.
        object_region: least and greatest corner of where objects may stand [m].
        condition: the external state that the motion depends on; empty where it is the object relative to the gripper
            at the start.
        condition_region: least and greatest of the conditions that are drawn, where there are any.
    """

    name: Name
    variant: Name
    boxes: Annotated[tuple[Box, ...], msgspec.Meta(max_length=512)]
    object_size: Vector3
    ellipsoid_radii: Vector3
    kicked_over_thresholds: Vector3
    start: Pose
    object_region: tuple[Vector3, Vector3]
    variants: Annotated[tuple[Name, ...], msgspec.Meta(max_length=16)] = ()
    condition: Condition = ()
    condition_region: tuple[Condition, Condition] = ((), ())


class Verdict(Message, frozen=True, kw_only=True):
    """The success criteria (thesis, Appendix E), judged now; a collision stays until the next episode.

    Attributes:
        reached: the object's centre lies in the gripper's ellipsoid, or all via-points were passed through.
        kicked_over: the object moved further than its threshold on some axis.
        collision: the robot touched the environment.
        collision_position: where first, base frame [m].
        collision_force: normal force of the first contact [N].
        collision_between: the robot's link and the thing that it touched first.
        ellipsoid_value: of eq. E.1, or the greatest (error / tolerance)^2 at a via-point; at most 1 where reached.
        object_displacement: since the episode started [m].
    """

    reached: bool
    kicked_over: bool
    collision: bool
    collision_position: Vector3 | None = None
    collision_force: Real = 0.0
    collision_between: tuple[Name, Name] | None = None
    ellipsoid_value: Real = 0.0
    object_displacement: Vector3 = (0.0, 0.0, 0.0)


class ExecutionState(Message, frozen=True, kw_only=True):
    """The motion under way, for whoever looks on or corrects it.

    Attributes:
        episode: its number.
        mode: who shapes it.
        prediction: what was asked for.
        progress: from 0 to 1.
        refined: the way-points that lie behind, shape (k, 3) [m].
    """

    episode: Count
    mode: Mode
    prediction: Motion
    progress: Real
    refined: Array


class EpisodeResult(Message, frozen=True, kw_only=True):
    """What became of an episode; repeated until the next one starts.

    Attributes:
        episode: its number.
        request: the number that the asker gave it.
        mode: who shaped it.
        completed: it ran to its end and was not cut short.
        reason: why not, empty where it was.
        prediction: what was asked for.
        refined: the reference including the operator's correction.
        commanded: what the joints were told, as a motion of the grasping frame.
        measured: what the arm did.
        verdict: at its end.
        operator_input: the operator displaced or rotated the master at some time.
        clamped: ticks in which something was clamped.
        held: time spent holding [s].
        duration: from the first motion to the verdict [s].
    """

    episode: Count
    request: Count
    mode: Mode
    completed: bool
    reason: Text
    prediction: Motion
    refined: Motion
    commanded: Motion
    measured: Motion
    verdict: Verdict
    operator_input: bool
    clamped: Count
    held: Real
    duration: Real


class AuthorityState(Message, frozen=True, kw_only=True):
    """Who may command; an empty holder means nobody.

    Attributes:
        holder: its name.
        epoch: grows with every change of holder; commands of another epoch are refused.
        expires_in: until the lease runs out if it is not renewed [s].
    """

    holder: Name
    epoch: Count
    expires_in: Real


class SafetyState(Message, frozen=True, kw_only=True):
    """What keeps the robot from moving, as measured.

    Attributes:
        emergency_stop: latched; release and a new authority are needed to move again.
        by: who pressed it.
        reason: for people.
        self_distance: least distance between parts of the robot [m].
    """

    emergency_stop: bool
    by: Name = ""
    reason: Text = ""
    self_distance: Real = 0.0


# --- seeing ------------------------------------------------------------------------------------------------------


class CameraImage(Message, frozen=True, kw_only=True):
    """One picture as JPEG.

    Attributes:
        camera: "head" or "wrist".
        width: [pixel].
        height: [pixel].
        data: the JPEG file.
        intrinsics: of the pinhole: fx, fy, cx, cy [pixel].
        pose: of the optical frame (x right, y down, z forward) in the base frame.
        captured_ns: stamp of the state that the picture shows, in the robot's monotonic clock [ns].
        object_pose: in simulation the true pose of the object in this picture, else none.
    """

    camera: Name
    width: Count
    height: Count
    data: Annotated[bytes, msgspec.Meta(max_length=1_000_000)]
    intrinsics: tuple[Real, Real, Real, Real]
    pose: Pose
    captured_ns: Count = 0
    object_pose: Pose | None = None


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


# --- learning and teaching ---------------------------------------------------------------------------------------


class Prediction(Message, frozen=True, kw_only=True):
    """What the model would do.

    Attributes:
        motion: in the base frame.
        deviations: one standard deviation on each axis, shape (n, 3) [m].
        model_version: of the model that predicts.
        object_position: the condition, in the base frame [m].
    """

    motion: Motion
    deviations: Array
    model_version: Count
    object_position: Vector3


class ModelState(Message, frozen=True, kw_only=True):
    """The learnt model as it lies on disk.

    Attributes:
        kind: which model.
        version: grows with every change, undo included.
        demonstrations: that it started from.
        updates: since then.
        scene: that it was taught in.
    """

    kind: Name
    version: Count
    demonstrations: Count
    updates: Count
    scene: Name


class Light(enum.Enum):
    """The operator's traffic light: red watch, amber wait, green act."""

    RED = "red"
    AMBER = "amber"
    GREEN = "green"


class Outcome(msgspec.Struct, frozen=True):
    """The three criteria, without their evidence."""

    reached: bool
    kicked_over: bool
    collision: bool

    @property
    def success(self) -> bool:
        """Reached, and neither kicked over nor collided."""
        return self.reached and not self.kicked_over and not self.collision


class Attempt(msgspec.Struct, frozen=True):
    """One episode of a teaching run.

    The motion was relative to the object's position, and right or wrong for the condition; that is empty where it is
    the object relative to the start.
    """

    scene: Name
    object_position: Vector3
    model_version: Count
    operator_input: bool
    verdict: Outcome
    duration_s: Real
    variant: Name
    mode: Mode
    condition: Condition = ()


class TeachingState(Message, frozen=True, kw_only=True):
    """Where the teaching workflow (Algorithm 1) stands.

    Attributes:
        phase: a word for the state.
        text: what the operator should know or do.
        light: may the operator act?
        refinements: attempts at this update so far.
        refinements_allowed: at most.
        updates: of the model in this run.
        updates_allowed: at most.
        attempts: every episode in order.
        finished: nothing more will happen.
        loop_closed: a prediction failed, was refined, learnt, and a later one succeeded by itself.
        reason: why not, empty where it did.
        actions: what the operator may do now, by name.
    """

    phase: Name
    text: Text
    light: Light
    refinements: Count = 0
    refinements_allowed: Count = 0
    updates: Count = 0
    updates_allowed: Count = 0
    attempts: Annotated[tuple[Attempt, ...], msgspec.Meta(max_length=1000)] = ()
    finished: bool = False
    loop_closed: bool = False
    reason: Text = ""
    actions: Annotated[tuple[Name, ...], msgspec.Meta(max_length=16)] = ()


class Recording(Message, frozen=True, kw_only=True):
    """Where the viewer shows and records.

    Attributes:
        path: of the .rrd file on the viewer's machine.
        viewer_url: of the page that shows the live view.
        recording_id: changes when the view has to be loaded anew.
        logged_ns: stamp of the newest robot state in the view [ns].
    """

    path: Text
    viewer_url: Text
    recording_id: Name
    logged_ns: Count = 0


class Figure(msgspec.Struct, frozen=True):
    """A measured number with its unit."""

    name: Name
    value: Real
    unit: Name


class TopicFigures(msgspec.Struct, frozen=True):
    """What a process saw on one topic in the last interval: rate [Hz], age and latency [s], drops by cause so far.

    A negative latency means that the clocks are not comparable.
    """

    topic: Name
    rate_hz: Real
    age: Real
    latency: Real
    malformed: Count = 0
    oversized: Count = 0
    wrong_version: Count = 0
    stale: Count = 0
    repeated: Count = 0
    future: Count = 0

    @property
    def drops(self) -> int:
        """All drops together."""
        return self.malformed + self.oversized + self.wrong_version + self.stale + self.repeated + self.future


class Heartbeat(Message, frozen=True, kw_only=True):
    """A process about itself, twice a second.

    Attributes:
        process: its name.
        pid: its process id.
        host: its machine.
        rate_hz: that it should step at.
        ticks: since the start.
        late_ticks: that began more than half a period late.
        period_p50: of the last interval [s].
        period_p99: of the last interval [s].
        step_p99: time that a step took, of the last interval [s].
        cpu_s: processor time since the start [s].
        memory: resident [byte].
        topics: what it receives.
        figures: what it measured besides.
    """

    process: Name
    pid: Count
    host: Name
    rate_hz: Real
    ticks: Count
    late_ticks: Count
    period_p50: Real
    period_p99: Real
    step_p99: Real
    cpu_s: Real
    memory: Count
    topics: Annotated[tuple[TopicFigures, ...], msgspec.Meta(max_length=64)] = ()
    figures: Annotated[tuple[Figure, ...], msgspec.Meta(max_length=64)] = ()
