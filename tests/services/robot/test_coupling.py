"""A hand that couples and decouples leads the robot by what it does while it is coupled, and nothing jumps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.motion.rotations import conjugate, exp_map, log_map, multiply
from services.robot.correction import Correction
from services.robot.execution import angle_between
from services.robot.teleoperation import LEASH, LEASH_TURN, LONGEST_S, MOST_POINTS, Coupling, Teleoperation
from sim.pose import Pose

PERIOD = 0.01
HERE = Pose(np.array([0.5, -0.1, 0.7]), np.array([0.5, 0.5, -0.5, 0.5]))
FARTHEST_STEP, WIDEST_STEP = 0.012, 0.015
"""What limits let pass in a period [m, rad]."""

displacements = st.tuples(*[st.floats(-1.0, 1.0)] * 3).map(np.array)
rotations = st.tuples(*[st.floats(-1.5, 1.5)] * 3).map(np.array)
hands = st.builds(Correction, displacements, rotations)
strokes = st.lists(st.tuples(hands, hands), min_size=1, max_size=6)
"""Where the hand is as it couples, and as it decouples."""


class Led:
    """A robot that follows exactly."""

    def __init__(self):
        self.coupling = Coupling()
        self.at = HERE
        self.motion = Teleoperation(lambda: self.at, PERIOD)

    @property
    def pose(self):
        return self.motion.reference

    def step(self, hand):
        self.at = self.motion.advance(self.coupling.step(hand))
        return self.at

    def stroke(self, start, end, steps=200):
        """Couple at a start and go to an end, evenly in position and orientation."""
        way = log_map(multiply(exp_map(end.turn), conjugate(exp_map(start.turn))))
        for share in np.linspace(0.0, 1.0, steps + 1):
            turn = log_map(multiply(exp_map(share * way), exp_map(start.turn)))
            yield self.step(Correction(start.offset + share * (end.offset - start.offset), turn))


def moved(before, after):
    return np.linalg.norm(after.position - before.position), angle_between(before.orientation, after.orientation)


@given(strokes)
def test_the_gripper_goes_by_what_the_hand_did_while_it_was_coupled(made):
    led, position, orientation = Led(), HERE.position, HERE.orientation
    for start, end in made:
        for _ in led.stroke(start, end):
            pass
        led.coupling.decouple()
        position = position + end.offset - start.offset
        orientation = multiply(multiply(exp_map(end.turn), conjugate(exp_map(start.turn))), orientation)
    np.testing.assert_allclose(led.pose.position, position, atol=1e-9)
    assert angle_between(led.pose.orientation, orientation) < 1e-6


@given(strokes)
def test_however_a_hand_couples_and_decouples_nothing_jumps(made):
    led = Led()
    for start, end in made:
        before = led.pose
        for number, pose in enumerate(led.stroke(start, end)):
            far, wide = moved(before, pose)
            if number == 0:
                assert far == 0.0
                assert wide < 1e-7
            assert far <= np.linalg.norm(end.offset - start.offset) / 200 + 1e-9
            assert wide <= np.pi / 200 + 1e-6
            before = pose
        led.coupling.decouple()


@given(hands, hands)
def test_a_decoupled_hand_moves_nothing(here, there):
    led = Led()
    led.step(here)
    led.coupling.decouple()
    before = led.pose
    np.testing.assert_array_equal(led.step(there).position, before.position)


def test_a_hand_that_turns_where_rotation_vectors_wrap_around_turns_on():
    led = Led()
    for angle in np.arange(0.0, 2.0 * np.pi, 0.01):
        shortest = log_map(exp_map(np.array([0.0, 0.0, angle])))
        led.step(Correction(np.zeros(3), shortest))
    assert angle_between(led.pose.orientation, HERE.orientation) == pytest.approx(0.0, abs=0.011)


@pytest.mark.parametrize(
    "pulled",
    [Correction(np.array([0.011, 0.0, 0.0]), np.zeros(3)), Correction(np.zeros(3), np.array([0.0, 0.011, 0.0]))],
)
def test_a_hand_that_pulls_where_the_arm_cannot_follow_slips_and_is_followed_back_at_once(pulled):
    stuck = Teleoperation(lambda: HERE, PERIOD)
    for _ in range(500):
        far, wide = moved(HERE, stuck.advance(pulled))
    assert far <= LEASH + 1e-9
    assert wide <= LEASH_TURN + 1e-9
    back = moved(HERE, stuck.advance(Correction(-pulled.offset, -pulled.turn)))
    assert max(back) == pytest.approx(max(far, wide) - 0.011)


@given(st.lists(st.tuples(displacements, rotations), min_size=1, max_size=20))
def test_where_the_orientation_gives_way_a_hand_that_turns_nothing_keeps_it(ways):
    """However the arm is oriented meanwhile, it is asked for what it was asked for."""
    arm = [HERE]
    motion = Teleoperation(lambda: arm[0], PERIOD)
    for offset, turn in ways:
        arm[0] = Pose(motion.reference.position, multiply(exp_map(turn), HERE.orientation))
        motion.advance(Correction(0.01 * offset, np.zeros(3)))
        np.testing.assert_array_equal(motion.reference.orientation, HERE.orientation)


FAR = Pose(HERE.position + 0.1, HERE.orientation)


@pytest.mark.parametrize(("measured", "at_once"), [(HERE, False), (FAR, True), (FAR, False)])
def test_after_a_hold_it_goes_on_from_where_the_arm_is(measured, at_once):
    motion = Teleoperation(lambda: HERE, PERIOD)
    motion.rejoin(measured, at_once=at_once)
    assert motion.reference is measured


def test_short_holds_that_come_often_move_nothing():
    led = Led()
    list(led.stroke(Correction(np.zeros(3), np.zeros(3)), Correction(np.zeros(3), np.array([0.0, 0.5, 0.0]))))
    before = led.pose
    for _ in range(100):
        led.motion.rejoin(Pose(before.position + 0.001, HERE.orientation), at_once=True)
    assert led.pose is before


def test_it_ends_by_itself_after_the_longest_time():
    motion = Teleoperation(lambda: HERE, period=1.0)
    still = Correction(np.zeros(3), np.zeros(3))
    for _ in range(round(LONGEST_S) - 1):
        motion.advance(still)
    assert not motion.finished
    motion.advance(still)
    assert motion.finished
    assert motion.progress == 1.0
    assert motion.points == MOST_POINTS
