"""The robot's port: the correction in contact, and what is told of the contact."""

import numpy as np
import pytest
from hypothesis import Phase as Stage
from hypothesis import given, settings
from hypothesis import strategies as st

from protocol.messages import Mode
from services.robot.contact import LARGEST, ContactPort
from tests.services.robot.arm_site import Site as ArmSite
from tests.services.robot.site import Site, straight

PERIOD = 0.01
INTO_THE_BASKET = 0.25  # [m] along x: the gripper meets it after 0.23 m
NO_WORK, NONE_RENDERED = 0.0, -1.0

metres = st.floats(-0.1, 0.1)


@settings(max_examples=12, deadline=None, phases=(Stage.explicit, Stage.reuse, Stage.generate))
@given(hand=st.lists(st.tuples(metres, metres, st.booleans()), min_size=5, max_size=40))
def test_where_nothing_is_touched_a_device_that_renders_contact_corrects_as_one_that_does_not_to_the_last_bit(hand):
    rendering, plain = _corrected(hand, NO_WORK), _corrected(hand, NONE_RENDERED)
    assert rendering == plain


def _corrected(hand, energy):
    """Offset, joints and clamps, period by period; the hand leaves neutral at once, so that it does correct."""
    site = Site()
    site.acquire()
    site.execute(Mode.REFINE, straight())
    site.run(0.6, master=(0.0, 0.0, 0.0), contact_energy=energy)
    seen = []
    for x, y, engaged in ((0.0, 0.05, True), *hand):
        site.run(PERIOD, master=(x, y, 0.0), engaged=engaged, contact_energy=energy)
        seen.append((site.state.offset, site.state.q, site.state.clamped))
    assert any(offset != (0.0, 0.0, 0.0) for offset, _, _ in seen)
    return seen


@pytest.mark.sim
def test_against_a_wall_the_correction_goes_no_further_than_credit_until_the_hand_has_worked_for_it():
    plain, rendering = _pressed(NONE_RENDERED), _pressed(NO_WORK)
    assert plain.state.offset[0] == pytest.approx(INTO_THE_BASKET, abs=1e-3)
    assert rendering.state.offset[0] < INTO_THE_BASKET - 0.01
    force = np.array(rendering.state.contact_force)
    assert force[0] < -1.0
    assert np.linalg.norm(force) <= LARGEST
    for _ in range(100):
        rendering.run(PERIOD, master=(INTO_THE_BASKET, 0.0, 0.0), contact_energy=1.0)
    assert rendering.state.offset[0] == pytest.approx(INTO_THE_BASKET, abs=2e-3)


@pytest.mark.sim
def test_what_the_contact_gives_back_is_told_and_no_contact_is_no_force():
    site = _pressed(NO_WORK)
    site.run(0.5, master=(INTO_THE_BASKET, 0.0, 0.0), contact_energy=2.0)
    assert site.state.contact_energy == pytest.approx(0.0, abs=1e-3)
    before = site.state.contact_energy
    for k in range(100):
        site.run(PERIOD, master=(INTO_THE_BASKET * (1.0 - k / 100), 0.0, 0.0), contact_energy=2.0)
        assert site.state.contact_energy >= before
        before = site.state.contact_energy
    assert before > 0.01
    assert site.state.contact_force == (0.0, 0.0, 0.0)


def _pressed(energy):
    site = ArmSite()
    site.acquire()
    site.refine(motion=site.lift(height=0.0, duration=8.0))
    for k in range(300):
        site.run(PERIOD, master=(INTO_THE_BASKET * min(1.0, k / 200), 0.0, 0.0), contact_energy=energy)
    return site


@given(st.lists(st.tuples(*[st.floats(-500.0, 500.0)] * 3), min_size=1, max_size=30))
def test_what_is_told_is_bounded_and_fades_to_nothing(forces):
    port = ContactPort(PERIOD)
    for force in forces:
        port.observe(np.array(force))
        assert np.linalg.norm(port.force) <= LARGEST * (1.0 + 1e-9)
    for _ in range(30):
        port.observe(np.zeros(3))
    assert not port.force.any()
    assert port.energy_in == 0.0
