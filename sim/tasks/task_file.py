"""A task from its file: TOML into the value that every task of an arm is."""

import math
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from sim.exceptions import DescriptionInvalid, TaskUnfit
from sim.pose import Pose
from sim.region import Region
from sim.robots import meshes
from sim.robots.gripper import pitched_down
from sim.robots.robot import Base
from sim.rotations import rotated
from sim.tasks import task_faults, written
from sim.tasks.arrangement import Arrangement, Mesh, Standing
from sim.tasks.reaching import ReachingScene
from sim.tasks.reading import Unfit, nearest, read
from sim.tasks.scene import Box, Eye, Group
from sim.tasks.success import Success
from sim.tasks.thing import Tag, Thing
from sim.tasks.way import AXES, Coordinate, Detour, Point, Way

SUFFIX = ".toml"
LARGEST = 1 << 20
"""Of such a file [byte]; more is some other one."""

Rgba = tuple[float, float, float, float]


def load_task(path: Path, *, ships: bool = False) -> ReachingScene:
    """Return the task that a file describes.

    Args:
        path: Of the file.
        ships: It is one of the project's own, found by its name.

    Raises:
        TaskUnfit: It is not there, cannot be parsed, or says what cannot be.
    """
    try:
        said = read(written.WrittenTask, tomllib.loads(_text(path)))
        for fault in task_faults.found(said):
            raise Unfit(fault)
        return replace(_task(said, path), file=None if ships else path.absolute())
    except tomllib.TOMLDecodeError as error:
        raise TaskUnfit(path, f"it is no TOML: {error}") from None
    except (Unfit, DescriptionInvalid) as error:
        raise TaskUnfit(path, str(error)) from None
    except RecursionError:
        raise TaskUnfit(path, "it is nested too deeply for a task") from None


def faults(path: Path) -> list[str]:
    """Return what is wrong in a file, a line each; nothing where it can be used.

    Raises:
        TaskUnfit: It is not there, or cannot be parsed.
    """
    try:
        said = read(written.WrittenTask, tomllib.loads(_text(path)))
        return list(task_faults.found(said)) or [str(error) for error in _raised(said, path)]
    except tomllib.TOMLDecodeError as error:
        raise TaskUnfit(path, f"it is no TOML: {error}") from None
    except Unfit as error:
        return [str(error)]


def _raised(said: written.WrittenTask, path: Path) -> Iterator[Exception]:
    try:
        _task(said, path)
    except (Unfit, DescriptionInvalid) as error:
        yield error


def _text(path: Path) -> str:
    try:
        if path.is_dir():
            raise TaskUnfit(path, "it is a folder; name a file")
        if path.stat().st_size > LARGEST:
            raise TaskUnfit(path, f"it is larger than {LARGEST >> 20} MiB: no task file")
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise TaskUnfit(path, error.strerror or str(error)) from None
    except UnicodeDecodeError:
        raise TaskUnfit(path, "it holds what is no UTF-8: save it as UTF-8") from None


def _task(said: written.WrittenTask, path: Path) -> ReachingScene:
    target = task_faults.target(said)
    things = [_thing(one, said) for one in (target, *(other for other in said.objects if other is not target))]
    arrangement = Arrangement(
        tuple(_standing(one, said) for one in said.boxes),
        tuple(_mesh(one, said, path) for one in said.meshes),
        said.frames,
    )
    return ReachingScene(
        name=said.name,
        about=said.about,
        variants=said.variants,
        start=_start(said.start),
        region=things[0].region,
        margin=said.margin,
        training_positions=np.array(said.training_places),
        eye=Eye(said.eye.position, said.eye.target),
        things=tuple(things),
        success=_success(said, things[0]),
        arrangement=arrangement,
        ways={variant: _way(way, f"corridors.{variant}") for variant, way in said.corridors.items()},
        bases={
            "" if kind == "default" else kind: Base(one.position, math.radians(one.yaw))
            for kind, one in said.base.items()
        },
    )


def _start(said: written.WrittenStart) -> Pose:
    if said.quaternion is not None:
        turned = np.array(said.quaternion)
        if not abs(np.linalg.norm(turned) - 1.0) < 1e-3:
            raise Unfit("start: quaternion: its length has to be 1")
        return Pose(np.array(said.position), turned / np.linalg.norm(turned))
    ahead = pitched_down(math.radians(said.pitch))
    if said.yaw:
        ahead = rotated(ahead, np.array([0.0, 0.0, math.radians(said.yaw)]))
    return Pose(np.array(said.position), ahead)


def _colour(said: written.Colour, task: written.WrittenTask, where: str) -> Rgba:
    if isinstance(said, str):
        if said not in task.colours:
            raise Unfit(f"{where}: there is no colour {said}; {nearest(said, task.colours)}")
        said = task.colours[said]
    if len(said) not in (3, 4) or not all(0.0 <= part <= 1.0 for part in said):
        raise Unfit(f"{where}: a colour has three numbers, or four, from 0 to 1")
    red, green, blue, opacity = (*said, 1.0)[:4]
    return red, green, blue, opacity


def _thing(said: written.WrittenObject, task: written.WrittenTask) -> Thing:
    return Thing(
        name=said.name,
        size=said.size,
        mass=said.mass,
        region=Region(said.region.lower, said.region.upper),
        round=said.shape == "cylinder",
        tag=None if said.tag is None else Tag(said.tag.dictionary, said.tag.id, said.tag.size),
        rgba=_colour(said.colour, task, f"objects {said.name}"),
    )


def _standing(said: written.WrittenBox, task: written.WrittenTask) -> Standing:
    x, y, z = said.size
    colour = _colour(said.colour, task, f"boxes {said.name}")
    box = Box(said.name, said.centre, (x / 2, y / 2, z / 2), colour, Group(said.kind), said.quaternion)
    return Standing(box, said.variants, said.frame, said.count, said.spread)


def _mesh(said: written.WrittenMesh, task: written.WrittenTask, path: Path) -> Mesh:
    file = (path.parent / said.file).absolute()
    if not file.is_file():
        raise Unfit(f"meshes {said.name}: mesh {said.file} is missing: put it beside the file")
    corners = said.scale * meshes.read(file).reshape(-1, 3)
    lower, upper = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    colour = _colour(said.colour, task, f"meshes {said.name}")
    return Mesh(
        said.name,
        file,
        said.position,
        said.scale,
        (lower[0], lower[1], lower[2]),
        (upper[0], upper[1], upper[2]),
        colour,
        said.quaternion,
        said.variants,
        said.frame,
    )


def _success(said: written.WrittenTask, target: Thing) -> Success:
    one = said.success
    placed = None if one.placed is None else Region(one.placed.lower, one.placed.upper)
    if one.placed_on:
        placed = _on(next(box for box in said.boxes if box.name == one.placed_on), target)
    return Success(
        one.reached,
        one.kicked_over,
        None if one.tilt is None else math.radians(one.tilt),
        one.may_touch,
        one.force,
        one.time,
        one.grasped,
        one.lifted,
        placed,
    )


def _on(box: written.WrittenBox, target: Thing) -> Region:
    """Where the centre of an object is that stands on a box, within a centimetre of height."""
    (x, y, z), (width, depth, height) = box.centre, box.size
    stands = z + height / 2 + target.size[2] / 2
    return Region((x - width / 2, y - depth / 2, stands - 0.01), (x + width / 2, y + depth / 2, stands + 0.01))


def _way(said: written.WrittenWay, where: str) -> Way:
    detour = None
    if said.detour is not None:
        one = said.detour
        detour = Detour(one.around, one.room, one.rounding, one.furthest)
    return Way(tuple(_point(point, where) for point in said.points), said.before, detour)


def _point(said: written.WrittenPoint, where: str) -> Point:
    pitch = math.radians(said.pitch)
    if said.object is not None:
        return Point(pitch, offset=said.object)
    return Point(pitch, tuple(_coordinate(getattr(said, axis), f"{where}: {axis}") for axis in AXES))


def _coordinate(said: float | written.WrittenCoordinate | None, where: str) -> Coordinate:
    if isinstance(said, float):
        return Coordinate(fixed=said)
    if said is None or (said.way is None) == (said.line is None):
        raise Unfit(f"{where}: a way-point has x, y and z, each a number, a way or a line; or object")
    return Coordinate(way=said.way, line=said.line)
