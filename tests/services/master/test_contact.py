"""Contact felt through a network, with the stylus in a passive hand: bounded, settling, never beyond its limit."""

import math

import numpy as np
import pytest
from hypothesis import Phase as Stage
from hypothesis import given, settings
from hypothesis import strategies as st

from lfd.passivity import DEBT, Port
from protocol.messages import Phase, RobotState
from services.master.contact import ContactForce, room_for
from services.master.feedback import STALE_S, Feedback
from services.robot.contact import CREDIT, LARGEST
from sim.person.stylus import StylusState
from tests.services.master.coupled import LONGEST_STEP, POSE, Channel, Coupled

CHANNELS = pytest.mark.parametrize(("jitter_ms", "loss"), [(0.0, 0.0), (30.0, 0.3)], ids=["even", "jitter and loss"])
DELAYS = pytest.mark.parametrize("delay_ms", [0, 50, 100, 200, 400])
LITTLE = 1e-3
"""What one sample can do beyond the bound where stylus, hand and wall move as they do [J]."""

QUICKLY = (Stage.explicit, Stage.reuse, Stage.generate)
"""An example takes a second: the first that fails says enough."""

small = st.floats(-5.0, 5.0)
forces = st.tuples(small, small, small)


def coupled(delay_ms, jitter_ms=0.0, loss=0.0, **wall):
    rng = np.random.default_rng(5)
    return Coupled(Channel(rng, delay_ms, jitter_ms, loss), Channel(rng, delay_ms, jitter_ms, loss), **wall)


def press(site, seconds, target):
    """The hand means to go through the wall, and gets there in half a second."""
    for k in range(50):
        site.run(0.01, target * (k + 1) / 50)
    site.run(seconds - 0.5)


@DELAYS
@CHANNELS
def test_a_passive_hand_at_a_stiff_wall_settles(delay_ms, jitter_ms, loss):
    site = coupled(delay_ms, jitter_ms, loss)
    site.run(1.0, 0.0)
    press(site, 2.5, 0.022)
    first = site.swing(2.0)
    site.run(10.0)
    assert site.swing(2.0) < 0.4 * first
    assert site.energy_out <= site.energy_in + CREDIT + DEBT + LITTLE
    # It is not by feeling nothing that it settles: hand and wall in series would push with 0.8 N without a network.
    assert -site.forces[-1][0] > 0.4


def test_without_the_controllers_the_same_coupling_grows(monkeypatch):
    """From where it has settled: nothing changes but that both ports let everything pass, and then not any more."""
    site = coupled(200)
    site.run(1.0, 0.0)
    press(site, 16.0, 0.022)
    settled = site.swing(1.0)
    with monkeypatch.context() as without:
        without.setattr(Port, "force", lambda port, wanted, velocity: wanted)
        without.setattr(Port, "step", lambda port, wanted, force: wanted)
        site.run(3.0)
        sooner = site.energy_out - site.energy_in
        site.run(12.0)
        grown, later = site.swing(1.0), site.energy_out - site.energy_in
    assert settled < 2e-4
    assert grown > 20.0 * settled
    assert later > sooner + CREDIT + DEBT + LITTLE
    site.run(10.0)
    assert site.swing(2.0) < 0.4 * grown


@DELAYS
@CHANNELS
def test_pressed_hard_the_force_stays_within_the_device_s_limit_beside_equation_14(delay_ms, jitter_ms, loss):
    site = coupled(delay_ms, jitter_ms, loss, limit=3.0, local=50.0)
    site.run(0.6, 0.0)
    press(site, 2.0, 0.06)
    assert max(math.hypot(*force) for force in site.forces) <= 3.0 + 1e-9
    assert max(abs(position) for position in site.positions) <= 0.06 + 1e-3


@st.composite
def couplings(draw):
    """Any of the networks, and a wall of any stiffness and damping."""
    delay_ms = draw(st.sampled_from([0, 50, 100, 200, 400]))
    channel = draw(st.floats(0.0, 50.0)), draw(st.floats(0.0, 0.3))
    wall = {"stiffness": draw(st.floats(200.0, 20_000.0)), "damping": draw(st.floats(0.0, 50.0))}
    return coupled(delay_ms, *channel, **wall)


@settings(max_examples=10, deadline=None, phases=QUICKLY)
@given(site=couplings(), targets=st.lists(st.floats(-0.02, 0.06), min_size=2, max_size=6))
def test_whatever_the_hand_does_no_more_comes_out_than_went_in(site, targets):
    """The first sample of a touch cannot be foreseen, and is the robot's: the hand is given none of it.

    On the whole, the work that it put in itself subtracted, it never has more than contact did, and the debt.
    """
    for target in targets:
        site.run(0.4, target)
        assert site.on_hand <= site.by_contact + DEBT + LITTLE
        one_sample = LARGEST * LONGEST_STEP
        assert site.energy_out <= site.energy_in + CREDIT + DEBT + LITTLE + site.touches * one_sample


@pytest.mark.parametrize("delay_ms", [0, 400])
def test_a_tenth_of_a_second_after_the_robot_was_heard_last_there_is_no_force(delay_ms):
    site = coupled(delay_ms, local=50.0)
    site.run(1.0, 0.0)
    press(site, 2.0, 0.03)
    assert site.forces[-1] != (0.0, 0.0, 0.0)
    site.heard = False
    site.run(STALE_S + 0.001)
    assert site.forces[-1] == (0.0, 0.0, 0.0)


@given(part=forces, beside=forces, limit=st.floats(0.1, 10.0))
def test_a_force_gets_the_room_that_is_left_beside_another(part, beside, limit):
    size = math.hypot(*beside)
    beside = tuple(b * min(1.0, limit / size) for b in beside) if size else beside
    given_room = room_for(part, beside, limit)
    assert math.hypot(*(a + b for a, b in zip(given_room, beside, strict=True))) <= limit * (1.0 + 1e-6)
    share = math.hypot(*given_room) / math.hypot(*part) if any(part) else 1.0
    assert share <= 1.0 + 1e-9
    assert given_room == pytest.approx([share * p for p in part], abs=1e-9)
    if math.hypot(*(a + b for a, b in zip(part, beside, strict=True))) <= limit * (1.0 - 1e-9):
        assert given_room == part


def told(force, energy=0.0, publisher=2):
    return RobotState(
        publisher=publisher,
        measured=POSE,
        reference=POSE,
        phase=Phase.EXECUTE,
        contact_force=force,
        contact_energy=energy,
    )


def test_where_nothing_is_touched_equation_14_is_what_it_was_to_the_last_bit():
    stylus = StylusState((0.01, -0.02, 0.03), (0.1, 0.0, -0.2))
    heard, unheard = Feedback(50.0, 2.0, 3.0), Feedback(50.0, 2.0, 3.0)
    for _ in range(600):
        heard.contact.hear(told((0.0, 0.0, 0.0)))
        assert heard.force(stylus, 0.0, 1e-3) == unheard.force(stylus, 0.0, 1e-3)


def test_a_robot_that_moves_further_than_the_hand_is_felt_as_by_a_lever():
    contact = ContactForce()
    contact.hear(told((0.0, 0.0, 2.0)), lever=1.5)
    for _ in range(200):
        force = contact.wanted((0.0, 0.0, 0.0), 1.0, 1e-3)
    assert force == pytest.approx((0.0, 0.0, 3.0))


def test_a_neutral_place_that_is_set_anew_is_no_work_of_the_hand():
    contact = ContactForce()
    contact.render((-2.0, 0.0, 0.0))
    contact.move((0.0, 0.0, 0.0))
    contact.move((0.01, 0.0, 0.0))
    assert contact.energy_in == pytest.approx(0.02)
    contact.move((0.15, 0.0, 0.0))
    assert contact.energy_in == pytest.approx(0.02)
