"""Every robot that ships: what its value promises holds in the simulator."""

from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

import sim.robots.models
from sim.exceptions import RobotOfItsOwn, UnknownRobot
from sim.robots.catalogue import DEFAULT, DEFAULT_NAME, NAMES, robot
from sim.robots.description import prepare
from sim.robots.gripper import Mount
from sim.robots.robot import HEAD_CAMERA, WRIST_CAMERA, Base, Manipulator
from sim.tasks import described, scene
from sim.tasks.reaching import ReachingScene
from sim.world.assembly import assemble
from sim.world.physics import World

pytestmark = pytest.mark.sim
EACH = pytest.mark.parametrize("arm", [robot(name) for name in NAMES], ids=NAMES)


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cache")


def alone(arm: Manipulator) -> ReachingScene:
    """A scene that the robot stands beside, with nothing around it."""
    place = scene("table", replace(arm, base=Base((-3.0, 0.0, 0.0)), stances={}))
    assert isinstance(place, ReachingScene)
    return place


def test_a_robot_is_one_file() -> None:
    (folder,) = sim.robots.models.__path__
    files = {path.stem for path in Path(folder).glob("*.py")} - {"__init__"}
    assert set(NAMES) == files >= {"tiago", "panda", "ur5", "xarm7", "so101"}
    room = Path(folder).parents[2]
    named = [path for path in room.glob("s*/**/*.py") if path.stem not in files]
    told = {path.name for path in named for name in files - {DEFAULT_NAME} if name in path.read_text()}
    assert told == set()


def test_the_default_one_is_first_and_stands_where_nobody_says_another() -> None:
    assert (NAMES[0], DEFAULT.kind) == (DEFAULT_NAME, DEFAULT_NAME)
    assert scene("table") is scene("table", DEFAULT)


def test_an_unknown_robot_is_refused_with_those_that_there_are() -> None:
    with pytest.raises(UnknownRobot, match=r"'pandaa': use one of tiago, panda.*or the path of a robot file"):
        robot("pandaa")


def test_a_scene_that_is_about_its_own_robot_takes_no_other() -> None:
    with pytest.raises(RobotOfItsOwn, match="scene particle has a robot of its own"):
        scene("particle", robot("panda"))


@EACH
def test_a_robot_goes_by_its_files_name_and_says_one_number_a_joint(arm: Manipulator) -> None:
    assert robot(arm.kind) is arm
    for posture in (arm.home, *(stance.posture for stance in arm.stances.values())):
        assert len(posture) == len(arm.joints)
    assert all(len(stance.held) in (0, len(arm.held)) for stance in arm.stances.values())
    assert {camera.name for camera in arm.cameras} >= {HEAD_CAMERA, WRIST_CAMERA}


@EACH
def test_every_limit_is_positive(arm: Manipulator) -> None:
    for joint in arm.joints:
        assert min(joint.acceleration, joint.jerk, joint.stiffness, joint.damping, joint.lag) > 0.0
        assert joint.jerk > joint.acceleration


@EACH
def test_what_moves_in_the_description_is_what_the_value_says(arm: Manipulator, cache: Path) -> None:
    model = mujoco.MjModel.from_xml_path(str(prepare(cache, arm).urdf))
    moving = {model.joint(number).name for number in range(model.njnt)}
    assert moving == set(arm.moving_names)


@EACH
def test_it_stands_still_at_home(arm: Manipulator, cache: Path) -> None:
    place = alone(arm)
    world = World(place, "clear", described(place, cache))
    home = np.array(arm.home)
    world.reset(place.training_positions[0], q=home)
    for _ in range(100):
        world.step(home, np.zeros(len(home)), arm.gripper.opening)
    seen = world.observe()
    np.testing.assert_allclose(seen.q, home, atol=1e-3)
    np.testing.assert_allclose(seen.qd, 0.0, atol=1e-3)


@EACH
def test_a_servo_follows_a_slow_reference_without_lag(arm: Manipulator, cache: Path) -> None:
    place = alone(arm)
    world = World(place, "clear", described(place, cache))
    q, speed = np.array(arm.home), np.full(len(arm.home), 0.05)
    world.reset(place.training_positions[0], q=q)
    for _ in range(100):
        q = q + 0.01 * speed
        world.step(q, speed, arm.gripper.opening)
    np.testing.assert_allclose(world.observe().q, q, atol=2e-3)


@EACH
def test_its_head_camera_looks_at_the_object(arm: Manipulator, cache: Path) -> None:
    place = scene("table", arm)
    model = assemble(place, described(place, cache))
    data = mujoco.MjData(model)
    for name, position in arm.positions(place.stance).items():
        data.joint(name).qpos[0] = position
    mujoco.mj_kinematics(model, data)
    mujoco.mj_camlight(model, data)
    camera = data.camera(HEAD_CAMERA)
    x, y, z = camera.xmat.reshape(3, 3).T @ (place.region.sample(np.random.default_rng(0)) - camera.xpos)
    assert abs(np.degrees(np.arctan2(y, -z))) < 18.0
    assert abs(np.degrees(np.arctan2(x, -z))) < 23.0


def test_what_a_robot_reaches_moves_with_its_base(cache: Path) -> None:
    arm = robot("panda")
    turned = arm.standing(Base((1.0, 2.0, 3.0), np.pi / 2))
    low, high = np.array(arm.reach.lower), np.array(arm.reach.upper)
    np.testing.assert_allclose(turned.reach.lower, [1.0 - high[1], 2.0 + low[0], 3.0 + low[2]], atol=1e-9)
    np.testing.assert_allclose(turned.reach.upper, [1.0 - low[1], 2.0 + high[0], 3.0 + high[2]], atol=1e-9)


def test_a_base_elsewhere_moves_the_whole_robot(cache: Path) -> None:
    arm = robot("panda")
    base = Base((0.3, -0.2, 0.4), 0.7)
    there, here = (mujoco.MjModel.from_xml_path(str(prepare(cache, arm, at).urdf)) for at in (base, Base()))
    tips = []
    for model in (there, here):
        data = mujoco.MjData(model)
        mujoco.mj_kinematics(model, data)
        tips.append(data.body("grasping_frame").xpos.copy())
    turn = np.array([[np.cos(0.7), -np.sin(0.7), 0.0], [np.sin(0.7), np.cos(0.7), 0.0], [0.0, 0.0, 1.0]])
    np.testing.assert_allclose(tips[0], turn @ tips[1] + base.position, atol=1e-9)


def test_another_value_is_another_description(cache: Path) -> None:
    arm = robot("panda")
    moved = replace(arm, gripper=replace(arm.gripper, mount=Mount("panda_hand", (0.0, 0.0, 0.01))))
    assert prepare(cache, arm) != prepare(cache, moved)
    assert prepare(cache, arm) == prepare(cache, arm)
