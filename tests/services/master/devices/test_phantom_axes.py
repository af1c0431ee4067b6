"""The axes of a stylus follow its operator's view: the same hand, turned; and nothing jumps."""

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.motion.rotations import exp_map, matrix_from_quaternion
from services.master.devices.phantom import TO_BASE
from services.master.feedback import SOFT_START_S
from tests.services.master.devices.phantom_desk import REFINING, Desk


def about_z(yaw):
    return matrix_from_quaternion(exp_map(np.array((0.0, 0.0, yaw))))


@given(
    yaw=st.floats(-3.1, 3.1), moved=st.tuples(*3 * [st.floats(-0.1, 0.1)]), turn=st.tuples(*3 * [st.floats(-1.0, 1.0)])
)
def test_what_the_hand_does_in_turned_axes_is_what_it_does_in_the_robot_s_turned(yaw, moved, turn):
    """Forward is forward as the operator sees it, turns and velocity alike; and what is felt comes from there."""
    told = {}
    for view in (0.0, yaw):
        desk = Desk(force_limit=30.0)
        desk.run(0.02, held=False, yaw=view)
        desk.run(0.02, yaw=view)
        desk.move(*moved)
        desk.driver.turned = TO_BASE.T @ matrix_from_quaternion(exp_map(np.array(turn))) @ TO_BASE
        sample = desk.run(SOFT_START_S + 0.2, yaw=view)
        told[view] = (sample.displacement, sample.rotation, sample.velocity, desk.driver.force)
    straight, turned = told[0.0], told[yaw]
    for one, other in zip(straight[:3], turned[:3], strict=True):
        np.testing.assert_allclose(other, about_z(yaw) @ one, atol=1e-9)
    np.testing.assert_allclose(turned[3], straight[3], atol=1e-6)


def test_axes_turn_only_while_the_stylus_is_let_go_and_nothing_jumps_then():
    desk = Desk()
    desk.run(0.02)
    desk.move(0.02, 0.0, 0.0)
    held = desk.run(0.1, yaw=1.5)
    assert (held.displacement, held.yaw) == (pytest.approx((0.02, 0.0, 0.0)), 0.0)
    desk.run(0.05, held=False, yaw=np.pi / 2)
    robot = msgspec.structs.replace(REFINING, offset=held.displacement)
    again = desk.run(0.02, robot, yaw=np.pi / 2)
    assert (again.displacement, again.yaw) == (pytest.approx((0.02, 0.0, 0.0)), np.pi / 2)
    desk.move(0.01, 0.0, 0.0)
    assert desk.run(0.02, robot, yaw=np.pi / 2).displacement == pytest.approx((0.02, 0.01, 0.0))


def test_who_looks_elsewhere_turns_no_axes():
    desk = Desk()
    desk.run(0.02, held=False, yaw=1.0)
    assert desk.run(0.02, held=False, focused=False).yaw == 1.0
