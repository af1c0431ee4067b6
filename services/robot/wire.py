"""The robot's own values as messages."""

import msgspec
import numpy as np
from numpy.typing import NDArray

from lfd.motion.trajectory import Trajectory
from protocol import messages
from services.bus.arrays import motion_to_wire, quaternion, vector3
from services.robot.execution import Execution
from services.robot.order import Finished
from services.robot.verdict import Verdict
from sim.pose import Pose
from sim.region import Region
from sim.tasks import AnyScene
from sim.tasks.scene import Box, Group

Array = NDArray[np.float64]

_NONE: messages.Vector3 = (0.0, 0.0, 0.0)


def pose(value: Pose) -> messages.Pose:
    """A pose."""
    return messages.Pose(position=vector3(value.position), orientation=quaternion(value.orientation))


def pose_of(message: messages.Pose) -> Pose:
    """A pose from the wire, its quaternion normalised."""
    turned = np.array(message.orientation)
    return Pose(np.array(message.position), turned / np.linalg.norm(turned))


def motion(value: Trajectory) -> messages.Motion:
    """A trajectory."""
    return motion_to_wire(value.positions, value.orientations, value.duration, value.opening)


def verdict(value: Verdict) -> messages.Verdict:
    """The success criteria."""
    return messages.Verdict(
        reached=value.reached,
        kicked_over=value.kicked_over,
        collision=value.collision is not None,
        collision_position=vector3(value.collision.position) if value.collision is not None else None,
        collision_force=value.collision.force if value.collision is not None else 0.0,
        collision_between=value.collision.between if value.collision is not None else None,
        ellipsoid_value=value.ellipsoid_value,
        object_displacement=vector3(value.displacement),
        object_tilt=value.tilt,
        missed=value.missed,
        unmet=value.unmet,
    )


def episode_result(finished: Finished) -> messages.EpisodeResult:
    """What became of an order."""
    order, outcome = finished.order, finished.outcome
    return messages.EpisodeResult(
        episode=order.episode,
        request=order.request,
        mode=order.mode,
        completed=outcome.completed,
        reason=outcome.reason,
        prediction=order.prediction,
        refined=motion(outcome.refined),
        commanded=motion(outcome.commanded),
        measured=motion(outcome.measured),
        verdict=verdict(outcome.verdict),
        operator_input=outcome.operator_input,
        clamped=outcome.clamped,
        held=outcome.held,
        duration=outcome.duration,
        cut=outcome.cut,
        progress=outcome.progress,
        clear_until=outcome.clear_until,
    )


def with_pace(state: messages.ExecutionState, execution: Execution) -> messages.ExecutionState:
    """The state of a motion under way, with how fast it goes and where it is corrected."""
    return msgspec.structs.replace(
        state,
        pace=execution.pace.asked,
        part=messages.Part(*execution.part),
        duration=execution.prediction.duration,
        look_ahead=execution.look_ahead,
    )


def scene_state(scene: AnyScene, variant: str, start: Pose, condition: Array) -> messages.SceneState:
    """The scene as it stands.

    Args:
        scene: which.
        variant: of it.
        start: of the next motion.
        condition: the external state that motions depend on in it, shape (c,); empty where it is the object's.
    """
    region = scene.region
    return messages.SceneState(
        name=scene.name,
        variant=variant,
        boxes=(*map(_box, scene.shown(variant)), *map(_sign, scene.targets(condition))),
        object_size=scene.object_size,
        ellipsoid_radii=scene.tolerances,
        kicked_over_thresholds=scene.kick_limits,
        kicked_over_tilt=scene.tipping_angle,
        start=pose(start),
        object_region=_corners(region) if scene.has_object else (_NONE, _NONE),
        variants=scene.variants,
        condition=tuple(condition.tolist()),
        condition_region=((), ()) if scene.has_object else (region.lower, region.upper),
        wide_open=scene.wide_open,
        training_places=tuple(tuple(place) for place in scene.training_positions[:32].tolist()),
    )


def _corners(region: Region) -> tuple[messages.Vector3, messages.Vector3]:
    return vector3(np.array(region.lower)), vector3(np.array(region.upper))


def _box(box: Box) -> messages.Box:
    solid = box.group is not Group.DETAIL
    return messages.Box(box.name, box.centre, box.half_sizes, box.quaternion, box.rgba, solid)


def _sign(box: Box) -> messages.Box:
    """What only shows where a target is."""
    return msgspec.structs.replace(_box(box), solid=False)
