"""The way through a task that a person would take who has not drawn it: straight on, or a bow over or round.

What is found is found once for a robot in a task and holds wherever the object stands: it is told as a drawn way is,
in shares of the way to the object. The ways of both variants pair way-point by way-point. Where no bow is clear of
everything, one is sampled.
"""

import hashlib
import inspect
import json
import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from functools import partial
from itertools import islice, product
from pathlib import Path

import numpy as np

from sim.cache import kept
from sim.exceptions import NoWay
from sim.person.steering import steer
from sim.planning import arm as planning_arm
from sim.planning import sampling
from sim.planning.arm import PlanningArm
from sim.pose import Pose
from sim.robots.gripper import pitched_down
from sim.rotations import rotated, rotation_to
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import Array, Corridor, Quaternion, Vector
from sim.tasks.way import Coordinate, Point, Way

CLEARANCE = 0.015
"""That a way keeps from what stands around the robot [m]."""

SHARES = (0.0, 0.15, 0.40, 0.65, 0.88)
"""Of the way from the start to the point before the object, at which the way-points are."""

_BOW = (0.0, 0.7, 1.0, 1.0, 0.6)  # share of a bow's height there
_HEIGHTS = (0.0, 0.04, 0.08, 0.12, 0.17, 0.22)  # [m] of a bow
_SIDES = ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0), (-0.6, 0.0, 0.8))
_BACK = (0.10, 0.14, 0.07)  # [m] from the grasp to the point before it, against the gripper's direction
_HALFWAY = 0.45  # of that, to the last way-point but one
_DEPTHS = ((0.2, 0.0), (0.0, 0.0), (0.2, 0.012), (0.0, 0.012), (0.1, 0.02), (-0.1, 0.012))
"""Where an object is grasped: share of its height above its centre; and how far the hand stays behind that [m]."""
_PITCHES = (0.0, 10.0, -10.0, 20.0, -20.0, 30.0, 45.0, -30.0)  # [deg] beside the start's
_STEEPEST = math.radians(90.0)
_SAMPLES = 40
_TRIED = 6  # grasps, at most
_SLACK = 0.35  # [rad] by which the hand gives way at a joint's limit, as it does under control
_NEAR_OBJECT = 0.002  # [m] that open fingers keep from it


@dataclass(frozen=True)
class Grasp:
    """How an object is grasped.

    Attributes:
        orientation: Of the grasping frame, scalar first.
        height: Above the object's centre [m].
        depth: How far the hand stays behind that point [m].
        back: From how far away it goes straight on [m].
    """

    orientation: Quaternion
    height: float = 0.0
    depth: float = 0.0
    back: float = 0.0

    @property
    def point(self) -> Array:
        """Of the grasping frame from the object's centre, shape (3,) [m]."""
        return np.array([0.0, 0.0, self.height]) - self.depth * self.ahead

    @property
    def before(self) -> Array:
        """The point before it, from where it goes straight on, shape (3,) [m]."""
        return self.point - self.back * self.ahead

    @property
    def ahead(self) -> Array:
        """Where the gripper points, shape (3,)."""
        w, x, y, z = self.orientation
        return np.array([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)])


def ways(scene: ReachingScene, cache: Path | None = None) -> dict[str, Way]:
    """Return the way through each variant, finding them at first use; it takes seconds.

    Args:
        scene: The task, its robot in it.
        cache: Where to keep them; see `sim.cache`.

    Raises:
        NoWay: There is none.
        SimError: The robot cannot be made.
    """
    name = f"ways-{scene.name}-{scene.manipulator.kind}-{_key(scene)}.json"
    told = json.loads(kept(name, partial(_write, scene), cache).read_text())
    return {variant: _read(way) for variant, way in told.items()}


def _key(scene: ReachingScene) -> str:
    modules = (planning_arm, sampling, inspect.getmodule(_key))
    texts = b"".join(Path(str(module.__file__)).read_bytes() for module in modules if module)
    return hashlib.sha256(texts + scene.told).hexdigest()[:16]


def _write(scene: ReachingScene, scratch: Path, target: Path) -> None:
    del target
    scratch.write_text(json.dumps({variant: asdict(way) for variant, way in _found(scene).items()}))


def _read(told: dict[str, object]) -> Way:
    points = told["points"]
    assert isinstance(points, list)
    return Way(
        tuple(
            Point(
                pitch=one["pitch"],
                coordinates=tuple(Coordinate(**each) for each in one["coordinates"]),
                offset=None if one["offset"] is None else tuple(one["offset"]),
                orientation=tuple(one["orientation"]),
            )
            for one in points
        ),
        before=tuple(told["before"]),  # type: ignore[arg-type]
    )


def _found(scene: ReachingScene) -> dict[str, Way]:
    arm = PlanningArm(scene)
    if arm.solve(scene.start, arm.seeds()) is None:
        raise NoWay(scene.name, scene.manipulator.kind, "it does not reach the start")
    possible = list(islice((grasp for grasp in _grasps(scene) if _reaches(arm, grasp)), _TRIED))
    if not possible:
        raise NoWay(scene.name, scene.manipulator.kind, "it does not reach the whole region")
    trained, changed = scene.variants
    for shown, corrected in ((_straight, _way), (_way, _way), (_sampled, _sampled)):
        for grasp in possible:
            before = shown(arm, trained, grasp)
            after = corrected(arm, changed, grasp) if before is not None else None
            if before is not None and after is not None:
                return {trained: before, changed: after}
    raise NoWay(scene.name, scene.manipulator.kind, "every way that was tried touches something")


def places(scene: ReachingScene) -> list[Array]:
    """Return where an object is tried: the middle of the region first, then its corners."""
    lower, upper = np.array(scene.region.lower), np.array(scene.region.upper)
    axes = [sorted({low, high}) for low, high in zip(lower.tolist(), upper.tolist(), strict=True)]
    return [(lower + upper) / 2, *(np.array(corner) for corner in product(*axes))]


def _grasps(scene: ReachingScene) -> Iterator[Grasp]:
    """Forward and down as at the start, then steeper and flatter; from near and far."""
    ahead = Grasp(_quaternion(scene.start.orientation)).ahead
    pitch = math.asin(min(1.0, max(-1.0, -float(ahead[2]))))
    yaw = math.atan2(float(ahead[1]), float(ahead[0])) if abs(pitch) < math.radians(85.0) else 0.0
    for beside, (height, depth), back in product(_PITCHES, _DEPTHS, _BACK):
        steep = pitch + math.radians(beside)
        if 0.0 <= steep <= _STEEPEST + 1e-9:
            turned = rotated(pitched_down(steep), np.array([0.0, 0.0, yaw]))
            yield Grasp(_quaternion(turned), height * scene.target.size[2], depth, back)


def _reaches(arm: PlanningArm, grasp: Grasp) -> bool:
    """The grasp and the point before it, wherever the object is, with open fingers beside it."""
    for place in places(arm.scene):
        arm.arrange(arm.scene.variants[0], place)
        for offset in (grasp.before, grasp.point):
            q = arm.solve(Pose(place + offset, np.array(grasp.orientation)), arm.seeds(4))
            if q is None or arm.touches(q, 0.0, 0.0):
                return False
    return True


def _straight(arm: PlanningArm, variant: str, grasp: Grasp) -> Way | None:
    """The straight way, where it is clear."""
    way = _bow(arm.scene, grasp, np.zeros(3))
    return way if all(is_clear(arm, variant, way, one, CLEARANCE) for one in places(arm.scene)) else None


def _way(arm: PlanningArm, variant: str, grasp: Grasp) -> Way | None:
    """The lowest bow that is clear wherever the object is; None where none is."""
    tried = places(arm.scene)
    for height in _HEIGHTS:
        for side in _SIDES if height else _SIDES[:1]:
            way = _bow(arm.scene, grasp, height * np.array(side))
            failed = next((n for n, one in enumerate(tried) if not is_clear(arm, variant, way, one, CLEARANCE)), -1)
            if failed < 0:
                return way
            tried.insert(0, tried.pop(failed))  # where one bow fails the next one does most likely
    return None


def _bow(scene: ReachingScene, grasp: Grasp, bow: Array) -> Way:
    beside = np.outer(_BOW[1:], bow)
    return _through(scene, grasp, np.array(SHARES[1:]), beside, None)


def _through(scene: ReachingScene, grasp: Grasp, shares: Array, beside: Array, turns: Array | None) -> Way:
    """The way past points beside the straight one to the point before the object, then straight on to the grasp."""
    first, last = scene.start.orientation, np.array(grasp.orientation)
    last = math.copysign(1.0, float(first @ last)) * last
    if turns is None:
        turn = rotation_to(first, last)
        turns = np.array([rotated(first, share * turn) for share in shares])
    points = [
        Point(0.0, tuple(Coordinate(way=float(share), plus=float(off)) for off in offsets), None, _quaternion(turned))
        for share, offsets, turned in zip(shares, beside, turns, strict=True)
    ]
    near = [
        Point(0.0, (), _vector(grasp.point - left * grasp.back * grasp.ahead), _quaternion(last))
        for left in (1.0, _HALFWAY, 0.0)
    ]
    return Way((*points, *near), before=_vector(grasp.before))


def is_clear(arm: PlanningArm, variant: str, way: Way, place: Array, clearance: float) -> bool:
    """Say whether the arm can follow a way to an object without touching anything.

    Args:
        arm: That follows.
        variant: Of the task.
        way: From its start.
        place: Of the object's centre, shape (3,) [m].
        clearance: That is kept from what stands there [m].
    """
    scene = arm.scene
    arm.arrange(variant, place)
    corridor = way.corridors(scene.start.position, scene.start.orientation, place)[0]
    motion = steer(_continuous(corridor), None, n=_SAMPLES)
    q = arm.solve(scene.start, arm.seeds())
    for position, orientation in zip(motion.positions, motion.orientations, strict=True):
        if q is not None:
            q = arm.solve(Pose(position, orientation), (q,), _SLACK)
        if q is None or arm.touches(q, clearance, _NEAR_OBJECT):
            return False
    return True


def _sampled(arm: PlanningArm, variant: str, grasp: Grasp) -> Way | None:
    """A bow where one is clear; else a way that was sampled to the middle of the region, and is clear there."""
    bow = _way(arm, variant, grasp)
    if bow is not None:
        return bow
    scene, place = arm.scene, places(arm.scene)[0]
    arm.arrange(variant, place)
    before = place + grasp.before
    path = sampling.path(arm, scene.start, Pose(before, np.array(grasp.orientation)), CLEARANCE / 2, _NEAR_OBJECT)
    if path is None:
        return None
    poses = [arm.pose(q) for q in path]
    legs = np.linalg.norm(np.diff([pose.position for pose in poses], axis=0), axis=1)
    covered = np.concatenate([[0.0], np.cumsum(legs)]) / max(float(legs.sum()), 1e-9)
    picked = [poses[int(np.argmin(np.abs(covered - share)))] for share in SHARES[1:]]
    straight = [scene.start.position + share * (before - scene.start.position) for share in SHARES[1:]]
    beside = np.array([pose.position for pose in picked]) - np.array(straight)
    turns = _one_hemisphere([scene.start.orientation, *(pose.orientation for pose in picked)])[1:]
    way = _through(scene, grasp, np.array(SHARES[1:]), beside, turns)
    return way if is_clear(arm, variant, way, place, 0.0) else None


def _continuous(corridor: Corridor) -> Corridor:
    return Corridor(corridor.positions, _one_hemisphere(list(corridor.orientations)))


def _one_hemisphere(orientations: list[Array]) -> Array:
    """The same, neighbours with the same sign, shape (n, 4)."""
    kept_signs = [orientations[0]]
    for one in orientations[1:]:
        kept_signs.append(math.copysign(1.0, float(one @ kept_signs[-1])) * one)
    return np.array(kept_signs)


def _vector(values: Array) -> Vector:
    x, y, z = values.tolist()
    return x, y, z


def _quaternion(values: Array) -> Quaternion:
    w, x, y, z = values.tolist()
    return w, x, y, z
