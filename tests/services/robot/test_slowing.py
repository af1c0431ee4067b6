"""An arm slows down smoothly before it comes where it must not be, and never on its way from there."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.robot.joints import SINGULAR, SLOWEST
from services.robot.slowing import Approach, Zone
from sim.pose import Pose
from tests.services.robot.test_joints import PERIOD, joints, kinematics

ZONE = Zone(0.005, 0.03, 0.01)
margins, rates = st.floats(0.0, 0.05), st.floats(0.0, 2.0)


@given(margin=margins, rate=st.floats(-2.0, 0.0))
def test_what_leads_away_or_along_is_never_slowed(margin, rate):
    assert ZONE.share(margin, rate) == 1.0


@given(margin=margins, further=st.floats(0.0, 0.01), rate=rates, faster=st.floats(0.0, 1.0))
def test_nearer_is_slower_and_at_the_end_nothing_comes_nearer_fast(margin, further, rate, faster):
    share = ZONE.share(margin, rate)
    assert 0.0 < share <= ZONE.share(margin + further, rate)
    assert ZONE.share(margin, rate + faster) * (rate + faster) >= share * rate - 1e-12, "a faster hand is no slower"
    assert ZONE.share(ZONE.end, rate) * rate <= ZONE.creep


@given(rate=st.floats(0.001, 2.0))
def test_there_is_neither_a_jump_nor_a_kink(rate):
    at = np.linspace(0.001, 0.04, 2000)
    shares = np.array([ZONE.share(margin, rate) for margin in at])
    slopes = np.diff(shares) / np.diff(at)
    assert np.max(np.abs(np.diff(slopes))) < 8.0 * (at[1] - at[0]) / (ZONE.edge - ZONE.end) ** 2


def test_the_approach_is_judged_by_the_arms_own_pace_not_by_the_slowed_one():
    whole, slowed = Approach(ZONE, PERIOD, 0.02), Approach(ZONE, PERIOD, 0.02)
    assert whole.share(0.019, 1.0) == pytest.approx(slowed.share(0.02 - 0.5 * 0.001, 0.5), abs=0.06)


def _led(moved, arm, way, speed, seconds):
    """What was said, and the least share, while the arm is led."""
    start, gone, said, least = arm.forward(moved.q), 0.0, set(), 1.0
    for _ in range(round(seconds / PERIOD)):
        gone += moved.near * speed * PERIOD
        said |= set(moved.follow(Pose(start.position + gone * way, start.orientation)))
        least = min(least, moved.near)
    return said, least


@pytest.mark.sim
def test_an_arm_that_is_stretched_out_slows_down_says_so_and_comes_back_at_its_pace():
    arm, moved = kinematics("ur5"), joints("ur5")
    out = arm.forward(moved.q).position * [1.0, 1.0, 0.0]
    out /= np.linalg.norm(out)
    said, least = _led(moved, arm, out, 0.15, 6.0)
    assert "slow: nearly singular" in said
    assert SLOWEST <= least < 0.8
    assert arm.dexterity(moved.q) < SINGULAR.edge
    _led(moved, arm, -out, 0.05, 1.0)  # the reference was beyond what the arm reaches
    again, least = _led(moved, arm, -out, 0.05, 1.0)
    assert "slow: nearly singular" not in again
    assert least > 0.95


@pytest.mark.sim
@pytest.mark.parametrize("name", ["tiago", "panda", "xarm7"])
def test_a_redundant_arm_comes_back_to_its_posture_however_often_it_goes_round(name):
    arm, moved = kinematics(name), joints(name)
    home, began = arm.forward(moved.q), moved.q
    for _ in range(10):
        for angle in np.linspace(0.0, 2.0 * np.pi, 101)[1:]:
            offset = 0.05 * np.array([0.0, np.sin(angle), 1.0 - np.cos(angle)])
            moved.follow(Pose(home.position + offset, home.orientation))
    for _ in range(200):
        moved.follow(home)
    assert np.max(np.abs(moved.q - began)) < 1e-2
