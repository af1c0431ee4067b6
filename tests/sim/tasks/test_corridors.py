"""Every scene is what it claims: the trained motion works, the change breaks it, the corridor mends it."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation, Slerp

from services.robot.kinematics import Kinematics
from services.robot.starts import Starts
from sim.pose import Pose
from sim.robots.description import RobotDescription
from sim.tasks import THESIS
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import Corridor
from sim.world.physics import CONTROL_PERIOD, World

pytestmark = pytest.mark.sim
SCENE = pytest.mark.parametrize("place", THESIS.values(), ids=THESIS)

DURATION = 10.0  # [s] about as long as the robot takes: in half of it no joint can follow all of a corridor
MARGIN = 0.03  # [m]
NEGLIGIBLE = 0.05  # [m] of a change of the way, without which a motion still succeeds
OFFSETS = ((0.0, 0.05, 0.05), (-0.1, -0.1, 0.0), (-0.1, 0.05, 0.1), (-0.05, 0.0, 0.0))  # [m]


class Rollout:
    """One execution of a corridor: what happened to the arm and to the object."""

    def __init__(
        self,
        world: World,
        kinematics: Kinematics,
        corridor: Corridor,
        *,
        margins: bool = False,
        to_collision: bool = False,
    ) -> None:
        scene = world.scene
        self.collided = False
        self.margin = np.inf
        self.object_before = world.observe().object_position
        q = world.observe().q
        for tick, (position, orientation) in enumerate(zip(*_along(corridor), strict=True)):
            q, qd = kinematics.solve_step(q, position, orientation, CONTROL_PERIOD)
            world.step(q, qd, scene.manipulator.gripper.opening)
            self.collided |= bool(world.observe().contacts)
            if self.collided and to_collision:
                break
            if margins and tick % 10 == 0:
                self.margin = min(self.margin, world.clearance())
        seen = world.observe()
        hand = kinematics.forward(seen.q)
        self.displacement = np.abs(seen.object_position - self.object_before)
        to_hand = Rotation.from_quat(hand.orientation, scalar_first=True).inv()
        offset = to_hand.apply(seen.object_position - hand.position)
        self.reached = bool(np.sum((offset / scene.reached_radii) ** 2) <= 1.0)


def _along(corridor: Corridor) -> tuple[np.ndarray, np.ndarray]:
    """Sample a cubic spline through the way-points, evenly in the length of the chords."""
    legs = np.linalg.norm(np.diff(corridor.positions, axis=0), axis=1)
    knots = np.concatenate([[0.0], np.cumsum(legs)]) / np.sum(legs)
    share = np.arange(1, round(DURATION / CONTROL_PERIOD) + 1) * CONTROL_PERIOD / DURATION
    rotations = Slerp(knots, Rotation.from_quat(corridor.orientations, scalar_first=True))(share)
    positions = CubicSpline(knots, corridor.positions, bc_type="clamped")(share)
    return positions, rotations.as_quat(scalar_first=True)


def _objects(place: ReachingScene) -> list[np.ndarray]:
    """Two opposite corners of the region, its middle, and a position inside it."""
    lower, upper = np.array(place.region.lower), np.array(place.region.upper)
    return [lower, upper, (lower + upper) / 2, place.region.sample(np.random.default_rng(3))]


@pytest.fixture(scope="module", params=THESIS.values(), ids=THESIS)
def stage(request: pytest.FixtureRequest, description: RobotDescription) -> tuple[World, Kinematics]:
    place: ReachingScene = request.param
    return World(place, place.variants[0], description), Kinematics(description.urdf, place.posture)


@pytest.mark.parametrize("changed", [False, True], ids=["trained", "changed"])
def test_each_variants_own_corridor_reaches_with_room_to_spare(stage: tuple[World, Kinematics], changed: bool) -> None:
    world, kinematics = stage
    variant = world.scene.variants[changed]
    for position in _objects(world.scene):
        for corridor in world.scene.corridors(variant, position):
            world.reset(position, variant)
            rollout = Rollout(world, kinematics, corridor, margins=True)
            assert not rollout.collided
            assert rollout.margin >= MARGIN
            assert rollout.reached
            assert np.all(rollout.displacement < world.scene.kicked_thresholds / 10)


def test_a_corridor_from_any_free_start_reaches(stage: tuple[World, Kinematics]) -> None:
    world, kinematics = stage
    scene = world.scene
    starts = Starts(kinematics, scene.start, scene.posture, self_distance=0.005)
    for variant, offset in zip(scene.variants * 2, OFFSETS, strict=True):
        start = Pose(scene.start.position + offset, scene.start.orientation)
        position = scene.region.sample(np.random.default_rng(3))
        world.reset(position, variant, starts.joints(start))
        assert not world.observe().contacts
        rollout = Rollout(world, kinematics, scene.corridor(variant, position, start))
        assert not rollout.collided
        assert rollout.reached
        assert np.all(rollout.displacement < scene.kicked_thresholds / 10)


def test_the_trained_motion_collides_in_the_changed_scene_where_the_safe_way_is_another(
    stage: tuple[World, Kinematics],
) -> None:
    world, kinematics = stage
    trained, changed = world.scene.variants
    collided = []
    for position in _objects(world.scene):
        before, after = (world.scene.corridor(variant, position).positions for variant in (trained, changed))
        world.reset(position, changed)
        shown = world.scene.corridor(trained, position)
        collided.append(Rollout(world, kinematics, shown, to_collision=True).collided)
        assert collided[-1] == (np.max(np.linalg.norm(after - before, axis=1)) > NEGLIGIBLE)
    assert sum(collided) > 1
