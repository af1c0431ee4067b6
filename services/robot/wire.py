"""The robot's own values as messages."""

import msgspec
import numpy as np
from numpy.typing import NDArray

from lfd.motion.trajectory import Trajectory
from protocol import messages
from services.bus.arrays import motion_to_wire, quaternion, vector3
from services.robot.control import Finished
from services.robot.verdict import Verdict
from sim.pose import Pose
from sim.tasks import AnyScene
from sim.tasks.particle import ParticleScene
from sim.tasks.scene import OBJECT_SIZE, Box, ReachingScene

Array = NDArray[np.float64]

_NONE: messages.Vector3 = (0.0, 0.0, 0.0)


def pose(value: Pose) -> messages.Pose:
    """A pose."""
    return messages.Pose(position=vector3(value.position), orientation=quaternion(value.orientation))


def motion(value: Trajectory) -> messages.Motion:
    """A trajectory."""
    return motion_to_wire(value.positions, value.orientations, value.duration)


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
    )


def episode_result(finished: Finished) -> messages.EpisodeResult:
    """What became of an order."""
    order, outcome = finished.order, finished.outcome
    return messages.EpisodeResult(
        episode=order.episode,
        request=order.execute.request,
        mode=order.execute.mode,
        completed=outcome.completed,
        reason=outcome.reason,
        prediction=order.execute.prediction,
        refined=motion(outcome.refined),
        commanded=motion(outcome.commanded),
        measured=motion(outcome.measured),
        verdict=verdict(outcome.verdict),
        operator_input=outcome.operator_input,
        clamped=outcome.clamped,
        held=outcome.held,
        duration=outcome.duration,
    )


def scene_state(scene: AnyScene, variant: str, start: Pose, condition: Array) -> messages.SceneState:
    """The scene as it stands.

    Args:
        scene: which.
        variant: of it.
        start: of the next motion.
        condition: the external state that motions depend on in it, shape (c,); empty where it is the object's.
    """
    bare = messages.SceneState(
        name=scene.name,
        variant=variant,
        boxes=_boxes(scene.boxes(variant)),
        object_size=_NONE,
        ellipsoid_radii=_NONE,
        kicked_over_thresholds=_NONE,
        start=pose(start),
        object_region=(_NONE, _NONE),
        variants=scene.variants,
        condition=tuple(condition.tolist()),
    )
    match scene:
        case ReachingScene():
            return msgspec.structs.replace(
                bare,
                object_size=OBJECT_SIZE,
                ellipsoid_radii=vector3(scene.reached_radii),
                kicked_over_thresholds=vector3(scene.kicked_thresholds),
                object_region=(vector3(scene.region.lower), vector3(scene.region.upper)),
            )
        case ParticleScene():
            first, second = scene.rings(condition)
            return msgspec.structs.replace(
                bare,
                boxes=(*bare.boxes, *_boxes((*first, *second))),
                ellipsoid_radii=(scene.tolerance,) * 3,
                condition_region=(scene.region.lower, scene.region.upper),
            )


def _boxes(boxes: tuple[Box, ...]) -> tuple[messages.Box, ...]:
    return tuple(messages.Box(box.name, box.centre, box.half_sizes, box.quaternion, box.rgba) for box in boxes)
