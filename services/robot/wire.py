"""The robot's own values as messages."""

import numpy as np
from numpy.typing import NDArray

from lfd.trajectory import Trajectory
from protocol import messages
from services.arrays import motion_to_wire, quaternion, vector3
from services.robot.control import Finished
from services.robot.verdict import Verdict
from sim.pose import Pose
from sim.scenes.scene import OBJECT_SIZE, Scene

Array = NDArray[np.float64]


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


def scene_state(scene: Scene, variant: str, start: Pose) -> messages.SceneState:
    """The scene in one of its variants, with a start of the next motion."""
    boxes = tuple(
        messages.Box(box.name, box.centre, box.half_sizes, box.quaternion, box.rgba) for box in scene.boxes(variant)
    )
    return messages.SceneState(
        name=scene.name,
        variant=variant,
        boxes=boxes,
        object_size=OBJECT_SIZE,
        ellipsoid_radii=vector3(scene.reached_radii),
        kicked_over_thresholds=vector3(scene.kicked_thresholds),
        start=pose(start),
        object_region=(vector3(scene.region.lower), vector3(scene.region.upper)),
        variants=scene.variants,
    )
