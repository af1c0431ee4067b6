"""The scene that the robot stands in: of the class `state`, too."""

from __future__ import annotations

from typing import Annotated

import msgspec

from protocol.messages.values import Condition, Message, Name, Opening, Pose, Quaternion, Real, Vector3


class Box(msgspec.Struct, frozen=True):
    """A box of the scene, in the base frame; half sizes [m], colour with alpha from 0 to 1.

    One that is not solid only shows something: nothing can touch it.
    """

    name: Name
    centre: Vector3
    half_sizes: Vector3
    orientation: Quaternion
    rgba: tuple[Real, Real, Real, Real]
    solid: bool = True


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
        kicked_over_tilt: largest angle between the object's upright axis and the vertical [rad].
        start: pose of the grasping frame from which the next motion starts.
        object_region: least and greatest corner of where objects may stand [m].
        condition: the external state that the motion depends on; empty where it is the object relative to the gripper
            at the start.
        condition_region: least and greatest of the conditions that are drawn, where there are any.
        training_places: where the target stands for first demonstrations: object positions [m], or conditions where the
            scene has them.
        wide_open: opening of the gripper in a task in which it takes part [m]; 0 where it takes none.
    """

    name: Name
    variant: Name
    boxes: Annotated[tuple[Box, ...], msgspec.Meta(max_length=512)]
    object_size: Vector3
    ellipsoid_radii: Vector3
    kicked_over_thresholds: Vector3
    start: Pose
    object_region: tuple[Vector3, Vector3]
    kicked_over_tilt: Real = 0.0
    variants: Annotated[tuple[Name, ...], msgspec.Meta(max_length=16)] = ()
    condition: Condition = ()
    condition_region: tuple[Condition, Condition] = ((), ())
    training_places: Annotated[tuple[Condition, ...], msgspec.Meta(max_length=32)] = ()
    wide_open: Opening = 0.0

    def __post_init__(self) -> None:
        for low, high in (self.object_region, self.condition_region):
            if len(low) != len(high) or any(a > b for a, b in zip(low, high, strict=True)):
                raise ValueError(f"a region cannot reach from {low} to {high}")
