"""Kinematics of every robot that ships: the same laws for all."""

from functools import cache

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from services.robot.execution import angle_between
from services.robot.kinematics import Kinematics
from services.robot.mechanism import JointsInOtherOrder, Unreachable
from sim.robots.catalogue import NAMES, robot
from sim.robots.description import GRASPING_FRAME, prepare

pytestmark = pytest.mark.sim
EACH = pytest.mark.parametrize("name", NAMES)
SHARES = st.lists(st.floats(0.0, 1.0), min_size=8, max_size=8)
DT = 0.01  # [s]
SAFE = 0.02  # [m] between a robot's parts at home


@cache
def kinematics(name: str) -> Kinematics:
    arm = robot(name)
    return Kinematics(prepare(robot=arm).urdf, np.array(arm.home), arm)


@cache
def simulated(name: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = mujoco.MjModel.from_xml_path(str(prepare(robot=robot(name)).urdf))
    return model, mujoco.MjData(model)


def posture(name: str, shares: list[float]) -> np.ndarray:
    """Joint positions at some shares of their ranges."""
    arm = kinematics(name)
    return arm.lower + np.array(shares[: len(arm.lower)]) * (arm.upper - arm.lower)


@EACH
@settings(max_examples=25, deadline=None)
@given(shares=SHARES)
def test_pinocchio_and_mujoco_put_the_grasping_frame_in_the_same_place(name: str, shares: list[float]) -> None:
    q = posture(name, shares)
    _, data = simulated(name)
    for joint, position in zip(robot(name).joint_names, q, strict=True):
        data.joint(joint).qpos[0] = position
    mujoco.mj_kinematics(*simulated(name))
    body, pose = data.body(GRASPING_FRAME), kinematics(name).forward(q)
    np.testing.assert_allclose(pose.position, body.xpos, atol=1e-9)
    assert abs(pose.orientation @ body.xquat) == pytest.approx(1.0, abs=1e-9)


@EACH
@settings(max_examples=10, deadline=None)
@given(shares=SHARES)
def test_a_pose_that_a_posture_has_is_found_again_within_the_limits(name: str, shares: list[float]) -> None:
    """About home: a stretched arm, and one at the ends of its ranges, may be found in no few steps."""
    arm, home = kinematics(name), np.array(robot(name).home)
    wanted = home + 0.8 * (np.array(shares[: len(home)]) - 0.5)
    pose = arm.forward(np.clip(wanted, arm.lower + 0.01, arm.upper - 0.01))
    found = arm.solve(pose.position, pose.orientation, [home], np.random.default_rng(0))
    again = arm.forward(found)
    np.testing.assert_allclose(again.position, pose.position, atol=1e-4)
    assert angle_between(again.orientation, pose.orientation) <= max(2e-3, arm.turn_slack)
    assert np.all((arm.lower <= found) & (found <= arm.upper))


@EACH
@settings(max_examples=10, deadline=None)
@given(shares=SHARES, way=st.tuples(*[st.floats(-2.0, 2.0)] * 3))
def test_steps_keep_all_limits_however_far_the_target(name: str, shares: list[float], way: tuple[float, ...]) -> None:
    arm = kinematics(name)
    q, pose = posture(name, shares), arm.forward(posture(name, shares))
    for _ in range(20):
        q_next, qd = arm.solve_step(q, pose.position + np.array(way), pose.orientation, DT)
        assert np.all(np.abs(qd) <= arm.velocity_limit + 1e-6)
        assert np.all((q_next >= arm.lower) & (q_next <= arm.upper))
        q = q_next


@EACH
def test_home_is_within_the_limits_and_away_from_itself(name: str) -> None:
    arm, home = kinematics(name), np.array(robot(name).home)
    assert np.all((arm.lower < home) & (home < arm.upper))
    assert arm.self_distance(home) > SAFE


@EACH
def test_some_postures_meet_the_robot_itself_and_most_do_not(name: str) -> None:
    arm, rng = kinematics(name), np.random.default_rng(0)
    distances = [arm.self_distance(rng.uniform(arm.lower, arm.upper)) for _ in range(300)]
    assert min(distances) < 0.0 < np.median(distances)


@EACH
def test_it_follows_a_circle_about_home(name: str) -> None:
    """To the millimetre, and an arm that can have any orientation keeps it."""
    arm, q = kinematics(name), np.array(robot(name).home)
    home = arm.forward(q)
    for tick in range(200):
        angle = 2.0 * np.pi * tick / 200
        target = home.position + 0.04 * np.array([0.0, np.sin(angle), 1.0 - np.cos(angle)])
        q, _ = arm.solve_step(q, target, home.orientation, DT)
        seen = arm.forward(q)
        np.testing.assert_allclose(seen.position, target, atol=1e-3)
        assert angle_between(seen.orientation, home.orientation) <= max(0.01, arm.turn_slack)


@EACH
def test_all_positions_lie_in_the_box_that_the_robot_says(name: str) -> None:
    arm, rng = kinematics(name), np.random.default_rng(1)
    reach = robot(name).standing(robot(name).base).reach
    positions = np.array([arm.forward(rng.uniform(arm.lower, arm.upper)).position for _ in range(2000)])
    assert np.all((np.array(reach.lower) <= positions) & (positions <= np.array(reach.upper)))


def test_an_arm_of_five_joints_turns_as_it_can_and_no_further() -> None:
    arm, home = kinematics("so101"), np.array(robot("so101").home)
    pose = arm.forward(home)
    aside = np.array([np.cos(0.2), 0.0, 0.0, np.sin(0.2)])  # a turn that no posture there has
    found = arm.forward(arm.solve(pose.position, aside, [home], np.random.default_rng(0)))
    np.testing.assert_allclose(found.position, pose.position, atol=1e-4)
    assert 0.01 < angle_between(found.orientation, aside) < arm.turn_slack
    behind = np.array([0.0, 0.0, 0.0, 1.0])
    with pytest.raises(Unreachable):
        arm.solve(pose.position, behind, [home], np.random.default_rng(0))


def test_joints_that_are_named_in_another_order_are_refused() -> None:
    from dataclasses import replace

    arm = robot("panda")
    swapped = replace(arm, joints=arm.joints[::-1])
    with pytest.raises(JointsInOtherOrder, match="name them in that order"):
        Kinematics(prepare(robot=arm).urdf, robot=swapped)


@pytest.mark.parametrize(
    ("link", "joint"), [("gripper_frame_link", "gripper_frame_joint"), ("wrist_link", "wrist_flex")]
)
def test_a_joint_may_be_called_as_a_link_is(link: str, joint: str, tmp_path) -> None:
    """One that is fixed, and one that moves."""
    arm = robot("so101")
    described = prepare(robot=arm).urdf.read_text(encoding="utf-8")
    assert described.count(f'"{joint}"')
    path = tmp_path / "robot.urdf"
    path.write_text(described.replace(f'"{link}"', f'"{joint}"'), encoding="utf-8")
    home = np.array(arm.home)
    same = Kinematics(path, home, arm)
    np.testing.assert_array_equal(same.forward(home).position, kinematics("so101").forward(home).position)
