"""The scripted operator leads the arm from what it predicted to where a person would."""

import numpy as np
import pytest

from protocol.messages import (
    Phase,
)
from sim.rotations import rotated, rotation_to
from tests.services.master.devices.site import PERIOD, POINTS, SAFE, Site, SteadySite, even


@pytest.mark.sim
def test_a_steady_hand_leads_the_robot_along_the_safe_way():
    site = SteadySite()
    errors = []
    while site.progress < 1.0:
        state = site.tick()
        errors.append(np.min(np.linalg.norm(even(SAFE)[0] - site.robot, axis=1)))
    assert state.device == "stylus"
    assert state.epoch == 3
    assert max(errors) < 0.03
    assert np.linalg.norm(site.robot - SAFE.positions[-1]) < 0.015


@pytest.mark.sim
def test_a_person_leads_the_robot_as_near_to_the_safe_way_as_people_repeat_theirs_and_to_the_object():
    errors, ends = [], []
    for seed in range(3):
        site = Site(seed)
        while site.progress < 1.0:
            site.tick()
            errors.append(np.min(np.linalg.norm(even(SAFE)[0] - site.robot, axis=1)))
        ends.append(np.linalg.norm(site.robot - SAFE.positions[-1]))
    assert 0.010 < np.sqrt(np.mean(np.square(errors))) < 0.052
    assert max(ends) < 0.045


@pytest.mark.sim
def test_the_hand_turns_the_robot_as_the_way_is_turned():
    """A prediction that was learnt rolled, more and more until it is wrong by half a radian at the object."""
    site = SteadySite()
    site.orientations = rotated(site.orientations, np.outer(np.linspace(0.0, 1.0, POINTS), [0.5, 0.0, 0.0]))
    while site.progress < 1.0:
        state = site.tick()
    assert np.linalg.norm(state.rotation) > 0.4
    assert np.linalg.norm(rotation_to(site.orientation, SAFE.orientations[-1])) < 0.03
    assert np.linalg.norm(site.robot - SAFE.positions[-1]) < 0.015


@pytest.mark.sim
def test_the_hand_lets_go_at_the_episodes_end_and_the_stylus_returns():
    site = SteadySite()
    for _ in range(400):
        state = site.tick()
    assert state.engaged
    assert np.linalg.norm(state.displacement) > 0.05
    site.phase = Phase.IDLE
    assert not site.tick().engaged
    for _ in range(200):
        state = site.tick()
    np.testing.assert_allclose(state.displacement, 0.0, atol=1e-3)


@pytest.mark.sim
def test_a_master_that_died_takes_over_where_the_robot_stands():
    site = SteadySite()
    site.orientations = rotated(site.orientations, [0.3, 0.0, 0.0])
    while site.progress < 0.4:
        site.tick()
    held, turned, progress = site.offset, site.turn, site.progress
    assert np.linalg.norm(held) > 0.05
    assert np.linalg.norm(turned) > 0.2
    site.start_master()
    site.clock.advance(1.0)
    while site.tick() is None:
        np.testing.assert_array_equal(site.offset, held)
        np.testing.assert_array_equal(site.turn, turned)
        assert site.progress == progress
        assert site.ticks < 1000
    assert site.states.latest().message.engaged
    moves, turns = [], []
    while site.progress < 1.0:
        before, turned = site.offset, site.turn
        site.tick()
        moves.append(np.linalg.norm(site.offset - before) / PERIOD)
        turns.append(np.linalg.norm(site.turn - turned) / PERIOD)
    assert max(moves) < 0.25
    assert max(turns) < 0.5
    assert np.linalg.norm(site.robot - SAFE.positions[-1]) < 0.015


@pytest.mark.sim
def test_a_cut_link_is_sat_out_with_the_hand_on_the_stylus():
    """Nothing is said while the robot is not heard; then the correction goes on from where it stands."""
    site = Site()
    while site.progress < 0.4:
        site.tick()
    before = site.offset
    for _ in range(150):
        site.clock.advance(PERIOD)
        site.service.step(site.clock.now_ns())
    assert site.states.fresh(site.clock.now_ns()) is None
    state = site.tick()
    assert state.engaged
    assert np.linalg.norm(np.array(state.displacement) - before) < 0.02


@pytest.mark.parametrize("fault", ["scene", "prediction", "orientation"])
def test_what_cannot_be_planned_is_not_touched(fault, caplog):
    site = Site()
    if fault == "scene":
        site.scene = "moon"
    elif fault == "prediction":
        site.announced = np.full((POINTS, 3), np.nan)
    else:
        site.orientations = 2.0 * site.orientations
    for _ in range(50):
        state = site.tick()
    assert not state.engaged
    assert caplog.text.count("episode 1 is not taught") == 1
