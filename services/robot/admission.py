"""Which requests are carried out: checks that end in one clear line."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lfd.exceptions import LfdError
from lfd.motion.rotations import conjugate, log_map, multiply
from lfd.motion.trajectory import Trajectory
from protocol.queries import Reset
from services.robot.execution import look_ahead
from services.robot.pace import FASTEST_PACE
from services.robot.refusal import Refusal
from services.robot.safety import ROUNDING
from sim.pose import Pose
from sim.tasks.scene import Scene

Array = NDArray[np.float64]

MOST_POINTS = 1000
SHORTEST_S, LONGEST_S = 0.5, 120.0
FASTEST = 1.0  # [m/s] along the prediction
FASTEST_TURN = 3.0  # [rad/s]
START_DISTANCE = 0.5  # [m] between the measured pose and the prediction's start
START_REACH = 0.3  # [m] of a start from the scene's own, along each axis


def admit_prediction(
    positions: Array,
    orientations: Array,
    duration: float,
    measured: Pose,
    waypoints: Sequence[float] = (),
    *,
    opening: Array | None = None,
) -> Trajectory:
    """The prediction, where it can be executed from the measured pose.

    Args:
        positions: shape (n, 3) [m].
        orientations: shape (n, 4).
        duration: [s].
        measured: pose of the grasping frame now.
        waypoints: phases at which an operator's waypoints are passed, by which a place on the motion is named.
        opening: of the gripper, shape (n,) [m]; None where it takes no part.

    Raises:
        Refusal: it is no trajectory, too long, too short, too fast, or starts too far away.
    """
    try:
        prediction = Trajectory(positions, orientations, duration, opening)
    except LfdError as error:
        raise Refusal(f"the prediction cannot be executed: {error}") from error
    if prediction.n_points > MOST_POINTS:
        raise Refusal(f"the prediction has {prediction.n_points} way-points, at most {MOST_POINTS} are allowed")
    if not SHORTEST_S <= duration <= LONGEST_S:
        raise Refusal(f"the prediction takes {duration:.3g} s: give {SHORTEST_S:g} to {LONGEST_S:g} s")
    with np.errstate(over="ignore", invalid="ignore"):  # what is too large for a number is too large
        _check_speeds(prediction, waypoints)
        distance = float(np.linalg.norm(prediction.positions[0] - measured.position))
    if not distance <= START_DISTANCE:
        raise Refusal(
            f"the prediction starts {distance:.2f} m away from the gripper, at most {START_DISTANCE:g} m is allowed:"
            " reset the robot first"
        )
    return prediction


def admit_pace(prediction: Trajectory, rate: float) -> None:
    """Let pass a pace at which the prediction keeps within the limits of its own.

    Args:
        prediction: that is executed.
        rate: of its time, of either sign.

    Raises:
        Refusal: it would move or turn too fast somewhere.
    """
    speed, turn_speed = float(np.max(_speeds(prediction))), float(np.max(_turn_speeds(prediction)))
    most = 1.0 / max(speed / FASTEST, turn_speed / FASTEST_TURN, 1.0 / FASTEST_PACE)
    if not abs(rate) <= most * (1.0 + ROUNDING):
        raise Refusal(
            f"at {abs(rate):.0%} of its pace the motion would be faster than {FASTEST:g} m/s or {FASTEST_TURN:g} rad/s:"
            f" give at most {most:.0%}"
        )


def _check_speeds(prediction: Trajectory, waypoints: Sequence[float]) -> None:
    speeds = _speeds(prediction)
    if not np.max(speeds) <= FASTEST:
        point = int(np.argmax(speeds))
        raise Refusal(
            f"the prediction moves at {np.max(speeds):.2f} m/s {_where(prediction, point, waypoints)}, at most"
            f" {FASTEST:g} m/s is allowed: give it more time"
        )
    turn_speeds = _turn_speeds(prediction)
    if not np.max(turn_speeds) <= FASTEST_TURN:
        point = int(np.argmax(turn_speeds))
        raise Refusal(
            f"the prediction turns at {np.max(turn_speeds):.2f} rad/s {_where(prediction, point, waypoints)}, at most"
            f" {FASTEST_TURN:g} rad/s is allowed: give it more time"
        )


def _speeds(prediction: Trajectory) -> Array:
    """Between way-points, shape (n - 1,) [m/s]."""
    lengths: Array = np.linalg.norm(np.diff(prediction.positions, axis=0), axis=1)
    return lengths / look_ahead(prediction)


def _turn_speeds(prediction: Trajectory) -> Array:
    """Between way-points, shape (n - 1,) [rad/s]."""
    turns = log_map(multiply(conjugate(prediction.orientations[:-1]), prediction.orientations[1:]))
    angles: Array = np.linalg.norm(turns, axis=1)
    return angles / look_ahead(prediction)


def _where(prediction: Trajectory, point: int, waypoints: Sequence[float]) -> str:
    """A place on a motion, as whoever showed it knows it: by the waypoint behind which it lies."""
    if not waypoints:
        return f"after way-point {point}"
    behind = sum(phase <= prediction.phases[point] for phase in waypoints)
    return f"after waypoint {behind}" if behind else "before waypoint 1"


def admit_target(scene: Scene, request: Reset) -> Array | None:
    """The place of the target that a reset asks for; None where it asks for none.

    Args:
        scene: that the robot stands in.
        request: the reset.

    Raises:
        Refusal: it asks for what this scene does not have.
    """
    if scene.has_object and request.condition is not None:
        raise Refusal(f"scene {scene.name} has no condition of its own: give an object position")
    if not scene.has_object and request.object_position is not None:
        raise Refusal(f"scene {scene.name} has no object: give a condition")
    asked = request.object_position if scene.has_object else request.condition
    return None if asked is None else np.array(asked)


def admit_reset(scene: Scene, variant: str, place: Array, start: Pose | None = None) -> None:
    """Let a reset pass that the scene allows.

    Args:
        scene: that the robot stands in.
        variant: asked for.
        place: of the target, asked for, shape (d,) [m].
        start: asked for; None for where it was put last.

    Raises:
        Refusal: there is no such variant, the target cannot stand there, or the start is far from the scene's.
    """
    if variant not in scene.variants:
        raise Refusal(f"scene {scene.name} has no variant {variant!r}: use one of {', '.join(scene.variants)}")
    if not scene.region.contains(place, scene.margin):
        lower, upper = np.subtract(scene.region.lower, scene.margin), np.add(scene.region.upper, scene.margin)
        raise Refusal(
            f"the target cannot stand at {_point(place)} m: give a place from {_point(lower)} to {_point(upper)} m"
        )
    home = scene.start.position
    if start is not None and not np.all(np.abs(start.position - home) <= START_REACH):
        raise Refusal(
            f"no motion can start at {_point(start.position)} m: give a place within {START_REACH:g} m of"
            f" {_point(home)} m along each axis"
        )


def _point(values: Array) -> str:
    return "(" + ", ".join(f"{value:.3f}" for value in values) + ")"
