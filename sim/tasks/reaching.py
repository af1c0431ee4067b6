"""A task of an arm: it reaches for an object."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from sim.robots.catalogue import DEFAULT
from sim.robots.robot import Base, Manipulator, Robot, Stance
from sim.tasks.arrangement import Arrangement
from sim.tasks.handling import handled
from sim.tasks.scene import Array, Box, Corridor, Scene, Vector
from sim.tasks.success import Success
from sim.tasks.thing import Thing
from sim.tasks.way import Way

_LONG = 0.9  # [m] to which arms reach to either side that people's scatter was measured with, or longer ones


@dataclass(frozen=True, eq=False, kw_only=True)
class ReachingScene(Scene):
    """An arm reaches for an object; a place is where the object's centre stands, shape (3,) [m].

    Attributes:
        manipulator: That reaches.
        things: Objects; motions are relative to the first.
        success: What it means.
        arrangement: What stands around the robot.
        ways: That somebody drew, by variant; where there are none they are found, see `sim.planning.ways`.
        bases: Where robots stand in it, by their kind, "" for any other; as the robot says where it says nothing.
        about: What it is, a line.
        file: That it was read from; None for one that ships.
    """

    has_object = True

    manipulator: Manipulator = DEFAULT
    things: tuple[Thing, ...]
    success: Success
    arrangement: Arrangement
    ways: Mapping[str, Way] = field(default_factory=dict)
    bases: Mapping[str, Base] = field(default_factory=dict)
    about: str = ""
    file: Path | None = None

    @property
    def reference(self) -> str:
        """See `Scene.reference`."""
        return self.name if self.file is None else str(self.file)

    @property
    def told(self) -> bytes:
        """All that its file says of it, and how its robot stands there: whoever keeps something for it goes by this."""
        numbers = (self.start.position, self.start.orientation, self.training_positions)
        said = (self.name, self.variants, self.region, self.things, self.success, self.arrangement, self.ways)
        meshes = (mesh.file.read_bytes() for mesh in self.arrangement.meshes)
        exact = [one.tolist() for one in numbers]
        return b"".join((repr((said, exact, self.manipulator, self.stance)).encode(), *meshes))

    @property
    def target(self) -> Thing:
        """The object that motions are relative to."""
        return self.things[0]

    @property
    def gripper(self) -> bool:
        """The gripper takes part: motions say how far it is open."""
        return self.success.gripper

    @property
    def wide_open(self) -> float:
        """See `Scene.wide_open`."""
        return self.manipulator.gripper.opening if self.gripper else 0.0

    @property
    def unsteadiness(self) -> float:
        """See `Scene.unsteadiness`: motions are as wide as the arm is long, and people scatter in proportion."""
        low, high = self.manipulator.reach.lower[1], self.manipulator.reach.upper[1]
        return min(1.0, (high - low) / 2 / _LONG)

    @property
    def turn_slack(self) -> float:
        """See `Scene.turn_slack`."""
        return self.manipulator.turn_slack

    @property
    def is_drawn(self) -> bool:
        """Somebody drew the ways through it."""
        return bool(self.ways)

    @cached_property
    def stance(self) -> Stance:
        """How the manipulator stands in it."""
        own = self.manipulator.stance(self.name)
        base = self.bases.get(self.manipulator.kind) or self.bases.get("")
        return own if base is None else replace(own, base=base)

    @cached_property
    def robot(self) -> Robot:
        """See `Scene.robot`."""
        return self.manipulator.standing(self.stance.base or Base())

    @property
    def posture(self) -> Array:
        """See `Scene.posture`."""
        return np.array(self.stance.posture)

    def layout(self, variant: str) -> tuple[Box, ...]:
        """See `Scene.layout`."""
        return self.arrangement.of(variant)

    def shown(self, variant: str) -> tuple[Box, ...]:
        """See `Scene.shown`: meshes and the objects that no motion is relative to."""
        meshes = (mesh.box(position) for mesh, position in self.arrangement.meshes_of(variant))
        return (*self.boxes(variant), *meshes, *(thing.box for thing in self.things[1:]))

    def routes(self, variant: str, place: Array) -> tuple[Corridor, ...]:
        """See `Scene.routes`; where none is drawn, as they are found."""
        ways = self.ways or self._found
        return ways[variant].corridors(self.start.position, self.start.orientation, place)

    @cached_property
    def _found(self) -> Mapping[str, Way]:
        # Imported here: physics takes a second, and who has drawn ways needs none.
        from sim.planning.ways import ways  # noqa: PLC0415

        return ways(self)

    def completed(self, route: Corridor, place: Array) -> Corridor:
        """See `Scene.completed`: the object is grasped, and more, where the gripper takes part."""
        return handled(route, place, self.success, self.wide_open) if self.gripper else route

    @property
    def object_size(self) -> Vector:
        """See `Scene.object_size`."""
        return self.target.size

    @property
    def tolerances(self) -> Vector:
        """See `Scene.tolerances`."""
        return self.success.reached

    @property
    def kick_limits(self) -> Vector:
        """See `Scene.kick_limits`."""
        return self.success.kicked_over

    @property
    def reached_radii(self) -> Array:
        """The same as an array, shape (3,) [m]."""
        return np.array(self.success.reached)

    @property
    def kicked_thresholds(self) -> Array:
        """The same as an array, shape (3,) [m]."""
        return np.array(self.success.kicked_over)

    @property
    def tipping_angle(self) -> float:
        """See `Scene.tipping_angle`."""
        return self.target.tipping_angle if self.success.tilt is None else self.success.tilt

    def missed_by(self, end: Array, target: Array, times: float) -> float:
        """See `Scene.missed_by`; along the line to the object."""
        return float(np.linalg.norm(target - end)) * (1.0 - 1.0 / times)
