"""The gripper while the robot moves: the motion's opening, the operator's in its place, and nothing that drops."""

from dataclasses import replace

import numpy as np
import pytest

from protocol import queries
from protocol.messages import Mode, Phase
from services.bus.arrays import from_wire
from services.robot.arm import Arm
from services.robot.assembly import kinematics_of
from services.robot.backends.particle import ParticleBackend
from services.robot.starts import Starts
from services.robot.via_points import ViaPointCriteria
from sim.tasks import PARTICLE
from tests.services.robot.site import FREE, NO_DESCRIPTION, Site, straight

WIDE = 0.1
N = 101
NOWHERE = (0.0, 0.0, 0.0)


class Gripping(ParticleBackend):
    """A particle with a gripper that is where it is told to be."""

    opening = WIDE

    def reset(self, place, variant, q):
        super().reset(place, variant, q)
        self.opening = WIDE

    def command(self, q, qd, opening):
        super().command(q, qd, opening)
        self.opening = opening

    def observe(self):
        return replace(super().observe(), opening=self.opening)


def arm_with_a_gripper(*, grips=True, opening=WIDE):
    kinematics = kinematics_of(PARTICLE, NO_DESCRIPTION)
    starts = Starts(kinematics, PARTICLE.start, PARTICLE.posture, 0.0)
    criteria = ViaPointCriteria(PARTICLE.via_x, PARTICLE.tolerance)
    backend = Gripping(PARTICLE, FREE)
    backend.connect()
    backend.opening = opening
    return Arm(backend, kinematics, criteria, starts, wide_open=WIDE, grips=grips)


def site_with_a_gripper(*, grips=True):
    site = Site(arm=arm_with_a_gripper(grips=grips))
    site.acquire()
    return site


def closing(at=0.5, duration=2.0):
    """A motion that closes the gripper at a share of its way."""
    shares = np.linspace(0.0, 1.0, N)
    return straight(duration, N, opening=np.where(shares < at, WIDE, 0.0))


def executing(site, motion=None, mode=Mode.AUTONOMOUS):
    site.execute(mode, closing() if motion is None else motion)
    master = NOWHERE if mode is not Mode.AUTONOMOUS else None
    while site.state.progress == 0.0:
        site.run(0.01, master=master)
    return site


def test_the_gripper_goes_with_the_motion():
    site = executing(site_with_a_gripper())
    site.run(0.8)
    assert site.state.opening_reference == WIDE
    site.run(0.4)
    assert (site.state.opening_reference, site.state.opening) == (0.0, 0.0)
    site.run(2.0)
    told = from_wire(site.result.refined.opening)
    assert np.flatnonzero(told < 0.5 * WIDE)[0] == pytest.approx(0.5 * N, abs=2)
    np.testing.assert_allclose(told, from_wire(site.result.commanded.opening))


def test_a_motion_without_a_gripper_leaves_it_and_says_nothing_of_it():
    site = executing(site_with_a_gripper(grips=False), straight(1.0))
    site.run(2.0)
    assert site.state.opening_reference == WIDE
    assert site.result.refined.opening is None


def test_the_operator_closes_earlier_than_the_motion_and_that_is_what_is_refined():
    site = executing(site_with_a_gripper(), mode=Mode.REFINE)
    site.run(0.5, master=NOWHERE)
    site.run(2.5, master=NOWHERE, opening=0.0)
    refined = from_wire(site.result.refined.opening)
    assert np.flatnonzero(refined < 0.5 * WIDE)[0] == pytest.approx(0.25 * N, abs=3)
    assert site.result.operator_input
    np.testing.assert_allclose(from_wire(site.result.refined.positions)[:, 1], 0.0, atol=1e-9)


def test_the_operator_keeps_the_gripper_open_longer_than_the_motion():
    site = executing(site_with_a_gripper(), mode=Mode.REFINE)
    site.run(1.5, master=NOWHERE, opening=1.0)
    assert site.state.opening_reference == WIDE
    site.run(0.1, master=NOWHERE, opening=0.25)
    assert site.state.opening_reference == pytest.approx(0.25 * WIDE)


def passing(site, progress, **asked):
    while site.state.progress < progress:
        site.run(0.01, master=NOWHERE, **asked)
    return site.state.opening_reference


def test_what_an_operator_asks_outside_the_part_that_is_corrected_does_not_count():
    site = site_with_a_gripper()
    site.execute(Mode.REFINE, closing(at=0.8))
    site.arm.episode.execution.part = (0.2, 0.4)
    assert passing(site, 0.1) == WIDE
    assert passing(site, 0.3, opening=0.0) == WIDE
    assert passing(site, 0.6, opening=0.0) == WIDE


def test_what_was_closed_in_the_part_that_is_corrected_is_not_dropped_behind_it():
    site = site_with_a_gripper()
    site.execute(Mode.REFINE, closing(at=0.8))
    site.arm.episode.execution.part = (0.2, 0.4)
    assert passing(site, 0.25) == WIDE
    assert passing(site, 0.3, opening=0.0) == 0.0
    assert passing(site, 0.7, opening=0.0) == 0.0


def test_what_was_asked_through_a_hold_is_no_new_wish_after_it_and_the_motion_opens_where_it_did():
    shares = np.linspace(0.0, 1.0, N)
    place = straight(2.0, N, opening=np.where((shares < 0.5) | (shares > 0.8), WIDE, 0.0))
    site = executing(site_with_a_gripper(), place, mode=Mode.REFINE)
    assert passing(site, 0.3, opening=0.0) == 0.0
    assert passing(site, 0.6, opening=0.0) == 0.0
    site.run(0.4, renew=False)
    assert site.state.phase is Phase.HOLD
    assert passing(site, 0.9, opening=0.0) == WIDE


def test_nobody_asks_anything_of_the_gripper_of_an_autonomous_motion():
    site = executing(site_with_a_gripper())
    site.run(0.3, master=NOWHERE, opening=0.0)
    assert site.state.opening_reference == WIDE


def holds(site):
    """Until it has closed the gripper on something."""
    while site.state.progress < 0.6:
        site.run(0.01)
    assert site.state.opening_reference == 0.0


@pytest.mark.parametrize("how", ["hold", "stop", "take-over", "finish"])
def test_what_it_holds_it_does_not_drop(how):
    site = executing(site_with_a_gripper())
    holds(site)
    match how:
        case "hold":
            site.run(3.0, renew=False)
        case "stop":
            site.press()
            site.run(1.0)
        case "take-over":
            site.acquire("bob", take_over=True)
            site.run(2.0)
        case "finish":
            site.finish()
            site.run(2.0)
    assert (site.state.opening_reference, site.state.opening) == (0.0, 0.0)


def test_the_ramp_to_the_next_motion_keeps_what_it_holds_until_the_motion_says_otherwise():
    site = executing(site_with_a_gripper(), closing(duration=1.0))
    site.run(2.0)
    site.execute(motion=straight(1.0, N, opening=np.full(N, WIDE)))
    site.run(0.05)
    assert (site.state.progress, site.state.opening_reference) == (0.0, 0.0)
    site.run(4.0)
    assert site.state.opening_reference == WIDE


def test_a_reset_opens_it():
    site = executing(site_with_a_gripper(), closing(duration=1.0))
    site.run(2.0)
    site.ask(queries.RESET, queries.Reset(site.epoch))
    assert site.state.opening_reference == WIDE


def test_a_hand_that_leads_alone_closes_it_and_lets_it_be():
    site = site_with_a_gripper()
    site.ask(queries.TELEOPERATE, queries.Teleoperate(site.epoch))
    site.run(0.2, master=NOWHERE)
    assert site.state.opening_reference == WIDE
    site.run(0.1, master=(0.001, 0.0, 0.0), opening=0.0)
    site.run(0.3, master=(0.001, 0.0, 0.0))
    assert site.state.opening_reference == 0.0


def test_a_motion_that_goes_back_opens_the_gripper_where_it_closed_it():
    site = executing(site_with_a_gripper())
    holds(site)
    site.ask(queries.PACE, queries.Pace(site.epoch, -1.0))
    while site.state.progress > 0.45:
        site.run(0.01)
    assert site.state.opening_reference == WIDE


def test_more_than_wide_open_is_wide_open():
    site = executing(site_with_a_gripper(), straight(1.0, N, opening=np.full(N, 0.5)))
    site.run(0.2)
    assert site.state.opening_reference == WIDE


def test_a_process_that_begins_with_something_in_the_gripper_goes_on_holding_it():
    assert Site(arm=arm_with_a_gripper(opening=0.03)).arm.fingers.told == 0.03
