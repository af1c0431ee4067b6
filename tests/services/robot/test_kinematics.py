import numpy as np
import pytest

from services.robot.kinematics import Kinematics
from services.robot.mechanism import Unreachable
from sim.robots.description import RobotDescription, prepare
from sim.tasks import THESIS, scene
from sim.tasks.reaching import ReachingScene

pytestmark = pytest.mark.sim
SCENE = pytest.mark.parametrize("place", THESIS.values(), ids=THESIS)
DT = 0.01  # [s]


@pytest.fixture(scope="module")
def description(tmp_path_factory: pytest.TempPathFactory) -> RobotDescription:
    return prepare(tmp_path_factory.mktemp("cache"))


@pytest.fixture
def kinematics(description: RobotDescription) -> Kinematics:
    return Kinematics(description.urdf)


@SCENE
def test_the_scenes_posture_is_its_start(place: ReachingScene, kinematics: Kinematics) -> None:
    pose = kinematics.forward(place.posture)
    np.testing.assert_allclose(pose.position, place.start.position, atol=2e-4)
    assert abs(pose.orientation @ place.start.orientation) == pytest.approx(1.0, abs=1e-6)


def test_the_solution_is_where_it_was_asked_for(kinematics: Kinematics) -> None:
    rng = np.random.default_rng(0)
    start = scene("table").start
    q = kinematics.solve(start.position, start.orientation, [], rng)
    np.testing.assert_allclose(kinematics.forward(q).position, start.position, atol=1e-4)
    assert np.all(q >= kinematics.lower)
    assert np.all(q <= kinematics.upper)


def test_a_pose_out_of_reach_is_refused_with_its_position(kinematics: Kinematics) -> None:
    start = scene("table").start
    with pytest.raises(Unreachable, match=r"3\.000, 0\.000, 1\.000"):
        kinematics.solve(np.array([3.0, 0.0, 1.0]), start.orientation, [], np.random.default_rng(0))


def test_steps_follow_a_slow_motion_closely(kinematics: Kinematics) -> None:
    place = scene("table")
    q = place.posture
    for tick in range(1, 101):
        position = place.start.position + tick * DT * np.array([0.02, 0.05, 0.05])
        q, _ = kinematics.solve_step(q, position, place.start.orientation, DT)
        np.testing.assert_allclose(kinematics.forward(q).position, position, atol=2e-4)


def test_steps_keep_all_limits_however_far_the_target(kinematics: Kinematics) -> None:
    rng = np.random.default_rng(2)
    place = scene("dishwasher")
    q = place.posture
    for _ in range(300):
        q_next, qd = kinematics.solve_step(q, rng.uniform(-2.0, 2.0, 3), place.start.orientation, DT)
        assert np.all(np.abs(qd) <= kinematics.velocity_limit + 1e-6)
        assert np.all((q_next >= kinematics.lower) & (q_next <= kinematics.upper))
        np.testing.assert_allclose(q_next, q + qd * DT, atol=1e-12)
        q = q_next


@SCENE
def test_the_start_is_far_from_self_collision(place: ReachingScene, kinematics: Kinematics) -> None:
    assert kinematics.self_distance(place.posture) > 0.1


def test_the_distance_to_itself_is_that_of_its_nearest_parts(kinematics: Kinematics) -> None:
    rng = np.random.default_rng(1)
    for _ in range(200):
        distance = kinematics.self_distance(rng.uniform(kinematics.lower, kinematics.upper))
        assert distance == min(pair.min_distance for pair in kinematics._geometry_data.distanceResults)


def test_some_configurations_meet_the_trunk_and_some_do_not(kinematics: Kinematics) -> None:
    rng = np.random.default_rng(0)
    distances = [kinematics.self_distance(rng.uniform(kinematics.lower, kinematics.upper)) for _ in range(200)]
    assert min(distances) < 0.0 < np.median(distances)
