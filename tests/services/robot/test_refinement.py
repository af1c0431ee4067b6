"""The operator's displacement and rotation on the arm, from the bus to the joints."""

import numpy as np
import pytest

from lfd.motion.rotations import exp_map, multiply
from protocol import queries
from protocol.messages import Mode, Phase
from services.bus.arrays import from_wire
from services.robot import safety
from tests.services.robot.arm_site import DURATION, SCENE, Site

pytestmark = pytest.mark.sim


@pytest.fixture
def site():
    return Site()


def test_the_operators_displacement_becomes_the_refinement(site):
    site.acquire()
    site.refine()
    site.run(2.5, master=(0.0, 0.0, 0.02))
    result = site.take_results()[0]
    assert result.operator_input
    assert result.completed
    correction = from_wire(result.refined.positions) - from_wire(site.predicted.positions)
    np.testing.assert_allclose(correction[[0, -1]], [[0.0, 0.0, 0.0], [0.0, 0.0, 0.02]], atol=1e-5)
    assert site.state.applied_sequence > 0
    assert site.state.applied_latency >= 0.0
    assert site.state.measured.position[2] == pytest.approx(SCENE.start.position[2] + 0.05, abs=2e-3)


@pytest.mark.parametrize("adapt", queries.Adapt)
def test_the_operators_rotation_becomes_the_refinement_s_orientation(site, adapt):
    turn = np.array([0.0, -0.2, 0.1])
    site.acquire()
    site.refine(motion=site.lift(duration=3.0), adapt=adapt)
    site.run(1.4, master=(0.0, 0.0, 0.0), rotation=tuple(turn.tolist()))
    np.testing.assert_allclose(site.state.turn, turn, atol=1e-6)
    site.run(3.5, master=(0.0, 0.0, 0.0), rotation=tuple(turn.tolist()))
    result = site.take_results()[0]
    assert result.operator_input, "turning alone is input too"
    assert result.completed
    wanted = multiply(exp_map(turn), SCENE.start.orientation)
    for motion in (result.refined, result.commanded, result.measured):
        orientations = from_wire(motion.orientations)
        np.testing.assert_allclose(np.linalg.norm(orientations, axis=1), 1.0, atol=1e-12)
        assert abs(orientations[-1] @ wanted) == pytest.approx(1.0, abs=1e-5)
    moved = from_wire(result.commanded.positions) - from_wire(site.predicted.positions)
    np.testing.assert_allclose(moved, 0.0, atol=0.02)  # the hand turns in no time, the joints within their limits
    np.testing.assert_allclose(moved[-1], 0.0, atol=1e-4)


def test_a_rotation_beyond_the_reach_is_clamped_and_said(site):
    site.acquire()
    site.refine(motion=site.lift(duration=3.0))
    site.run(0.6, master=(0.0, 0.0, 0.0), rotation=(0.0, -1e9, 0.0))
    assert "rotation" in site.state.clamped
    site.run(3.0, master=(0.0, 0.0, 0.0), rotation=(0.0, -1e9, 0.0))
    assert np.linalg.norm(site.state.turn) <= safety.ROTATION_REACH * (1.0 + 1e-6)


def test_a_refinement_holds_when_the_master_falls_silent_and_goes_on_when_it_is_back(site):
    site.acquire()
    site.refine()
    site.run(0.4, master=(0.0, 0.0, 0.01), rotation=(0.0, -0.1, 0.0))
    site.run(0.09)
    assert site.state.phase is Phase.EXECUTE
    site.run(0.04)
    held = site.state
    assert held.phase is Phase.HOLD
    assert "100 ms" in held.hold_reason
    site.run(0.4)
    assert held.turn[1] < 0.0
    assert (site.state.progress, site.state.offset, site.state.turn, site.state.reference) == (
        held.progress,
        held.offset,
        held.turn,
        held.reference,
    )
    site.run(2.0, master=(0.0, 0.0, 0.01))
    result = site.take_results()[0]
    assert result.completed
    assert result.held == pytest.approx(0.42, abs=0.03)
    assert result.refined.duration == pytest.approx(DURATION)


def test_a_master_of_another_epoch_moves_nothing(site):
    site.acquire()
    site.execute(Mode.REFINE)
    site.run(1.0, master=(0.0, 0.0, 0.01), epoch=site.epoch - 1)
    assert site.state.phase is Phase.HOLD
    assert site.state.offset == (0.0, 0.0, 0.0)
