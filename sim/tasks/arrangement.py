"""What stands around the robot, as data: boxes and meshes, in both variants of a task or in one."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from sim.rotations import turned
from sim.tasks.scene import NO_ROTATION, Box, Group, Quaternion, Vector

ORIGIN = ""
"""The frame of what stands in the task's own."""


@dataclass(frozen=True)
class Standing:
    """A box, or a row of equal ones.

    Attributes:
        box: In its frame; of a row the one in the middle, whose name the others have with their number.
        variants: That it stands in; all where there is none.
        frame: That its centre is told in.
        count: Of the row; 1 is a single box.
        spread: From the first of a row to the last [m].
    """

    box: Box
    variants: tuple[str, ...] = ()
    frame: str = ORIGIN
    count: int = 1
    spread: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Mesh:
    """A thing of any shape, from a file; it collides as its convex hull.

    Attributes:
        name: Unique in its task.
        file: STL.
        position: Of the file's origin, in its frame [m].
        quaternion: How it is turned, scalar first.
        scale: Of the file's numbers.
        lower: Least corner of the scaled mesh, in its own axes [m].
        upper: Greatest corner [m].
        rgba: Colour.
        variants: See `Standing`.
        frame: See `Standing`.
    """

    name: str
    file: Path
    position: Vector
    scale: float
    lower: Vector
    upper: Vector
    rgba: tuple[float, float, float, float]
    quaternion: Quaternion = NO_ROTATION
    variants: tuple[str, ...] = ()
    frame: str = ORIGIN

    def box(self, origin: Vector) -> Box:
        """Return the box around it.

        Args:
            origin: Where the file's origin is [m].
        """
        lower, upper = np.array(self.lower), np.array(self.upper)
        x, y, z = (np.array(origin) + turned(np.array(self.quaternion), (lower + upper) / 2)).tolist()
        half_x, half_y, half_z = ((upper - lower) / 2).tolist()
        return Box(self.name, (x, y, z), (half_x, half_y, half_z), self.rgba, Group.PANEL, self.quaternion)


@dataclass(frozen=True)
class Arrangement:
    """All that stands there.

    Attributes:
        boxes: In the order in which they are drawn.
        meshes: Beside them.
        frames: Where each frame is in each variant: what is moved from one variant to the other [m].
    """

    boxes: tuple[Standing, ...] = ()
    meshes: tuple[Mesh, ...] = ()
    frames: Mapping[str, Mapping[str, Vector]] = field(default_factory=dict)

    def of(self, variant: str) -> tuple[Box, ...]:
        """Return the boxes of a variant, each row as many."""
        return tuple(self._boxes(variant))

    def meshes_of(self, variant: str) -> tuple[tuple[Mesh, Vector], ...]:
        """Return the meshes of a variant and where the origin of each is [m]."""
        return tuple(
            (mesh, self._placed(mesh.frame, variant, mesh.position))
            for mesh in self.meshes
            if _there(mesh.variants, variant)
        )

    def _boxes(self, variant: str) -> Iterator[Box]:
        for one in self.boxes:
            if not _there(one.variants, variant):
                continue
            box = one.box
            centre = self._placed(one.frame, variant, box.centre)
            if one.count == 1:
                yield _moved(box, box.name, centre)
                continue
            along = (np.linspace(-extent / 2, extent / 2, one.count).tolist() for extent in one.spread)
            for number, offset in enumerate(zip(*along, strict=True)):
                yield _moved(box, f"{box.name}_{number}", _sum(centre, offset))

    def _placed(self, frame: str, variant: str, position: Vector) -> Vector:
        return position if frame == ORIGIN else _sum(self.frames[frame][variant], position)


def _there(variants: tuple[str, ...], variant: str) -> bool:
    return not variants or variant in variants


def _sum(first: Vector, second: Vector) -> Vector:
    x, y, z = (a + b for a, b in zip(first, second, strict=True))
    return x, y, z


def _moved(box: Box, name: str, centre: Vector) -> Box:
    return Box(name, centre, box.half_sizes, box.rgba, box.group, box.quaternion)
