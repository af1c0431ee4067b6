"""A motion goes on only while an operator is present, and after a long hold only when somebody asks for it."""

import numpy as np
import pytest

from protocol import messages, queries, topics
from protocol.messages import Mode, Phase
from protocol.queries import Accepted, Refused
from services.robot.easing import EASE_S
from services.robot.hold import ANOTHER_AUTHORITY, TOO_LONG
from tests.services.robot.site import Site, straight

MODES = pytest.mark.parametrize("mode", Mode)
RESTING = (0.0, 0.0, 0.0)


@pytest.fixture
def site():
    site = Site()
    site.acquire()
    return site


def going(site, mode=Mode.AUTONOMOUS):
    """An episode under way, past its ramp."""
    site.execute(mode)
    site.run(0.8, master=RESTING)
    assert site.state.phase is Phase.EXECUTE
    return site


def resume(site, epoch=None):
    return site.ask(queries.RESUME, queries.Resume(site.epoch if epoch is None else epoch))


@MODES
def test_every_motion_holds_a_fifth_of_a_second_after_the_operator_was_last_present(site, mode):
    going(site, mode)
    site.run(0.19, renew=False, master=RESTING)
    assert site.state.phase is Phase.EXECUTE
    site.run(0.03, renew=False, master=RESTING)
    held = site.state
    assert (held.phase, held.hold_reason) == (Phase.HOLD, "no operator was present for more than 200 ms")
    site.run(1.0, renew=False, master=RESTING)
    assert (site.state.q, site.state.progress) == (held.q, held.progress)


@pytest.mark.parametrize("changed", [{"holder": "eve"}, {"epoch": 1}, {"holder": ""}])
def test_a_renewal_of_another_holder_or_epoch_says_nothing_of_the_operator(site, changed):
    going(site)
    for _ in range(50):
        renewal = {"holder": "ann", "epoch": site.epoch} | changed
        site.operator.publish(topics.AUTHORITY_RENEWAL, messages.AuthorityRenewal(**renewal))
        site.run(0.01, renew=False)
    assert site.state.phase is Phase.HOLD


@pytest.mark.parametrize("changed", [{"holder": "eve"}, {"epoch": 1}, {"holder": "", "epoch": 0}])
def test_a_master_of_another_holder_or_epoch_moves_nothing(site, changed):
    going(site, Mode.REFINE)
    for _ in range(50):
        state = {"holder": "ann", "epoch": site.epoch, "engaged": True, "displacement": (0.0, 0.1, 0.0)} | changed
        site.operator.publish(topics.MASTER_STATE, messages.MasterState(**state))
        site.run(0.01)
    assert site.state.phase is Phase.HOLD
    assert site.state.offset == RESTING


def test_a_master_of_the_authority_before_counts_no_more(site):
    going(site, Mode.REFINE)
    site.run(0.5, master=(0.0, 0.1, 0.0))
    site.acquire()
    site.run(0.6)
    assert "nothing was heard of the operator's keys or device under this authority" in site.state.hold_reason


@MODES
def test_a_short_absence_is_forgiven(site, mode):
    going(site, mode)
    site.run(0.5, renew=False, master=RESTING)
    assert (site.state.phase, site.state.waiting) == (Phase.HOLD, False)
    site.run(0.05, master=RESTING)
    assert site.state.phase is Phase.EXECUTE


@MODES
def test_after_a_long_absence_the_robot_waits_to_be_asked(site, mode):
    going(site, mode)
    site.run(0.8, renew=False)
    held = site.state
    assert held.waiting
    site.run(1.0, master=RESTING)
    assert (site.state.phase, site.state.q) == (Phase.HOLD, held.q)
    assert site.state.hold_reason == f"{TOO_LONG} (no operator was present for more than 200 ms)"
    assert resume(site) == Accepted()
    site.run(2.0, master=RESTING)
    assert site.result.completed


def test_going_on_ramps_from_the_measured_pose(site):
    going(site)
    site.run(1.0, renew=False)
    site.arm._joints.stand(site.arm._joints.q + np.array([0.0, 0.05, 0.0]))  # somebody moved it
    site.run(0.1)
    resume(site)
    assert site.state.phase is Phase.RAMP
    assert site.state.q[1] == pytest.approx(0.05, abs=1e-3)
    site.run(0.6)
    assert site.state.phase is Phase.EXECUTE
    assert site.state.q[1] == pytest.approx(0.0, abs=1e-9)


def test_going_on_is_asked_under_the_present_authority_and_only_where_something_waits(site):
    assert resume(site) == Refused("no episode waits to be asked: nothing to go on with")
    going(site)
    assert resume(site) == Refused("no episode waits to be asked: nothing to go on with")
    site.run(1.0, renew=False)
    assert "epoch" in resume(site, epoch=site.epoch - 1).reason
    assert site.state.phase is Phase.HOLD
    site.press("bob", "smoke")
    assert "smoke" in resume(site).reason


def test_a_request_to_go_on_does_not_outlast_a_short_hold(site):
    going(site)
    site.run(1.5, renew=False)
    site.acquire()
    site.run(0.3, renew=False)
    assert resume(site) == Accepted()
    site.run(1.0, renew=False)
    site.run(1.0)
    assert (site.state.phase, site.state.waiting) == (Phase.HOLD, True)


@MODES
@pytest.mark.parametrize("away", [0.0, 0.1, 1.5])
def test_an_authority_that_is_regained_moves_nothing(site, mode, away):
    going(site, mode)
    site.ask(queries.RELEASE, queries.ReleaseAuthority("ann", site.epoch))
    site.run(away, renew=False)
    held = site.state.q
    site.acquire()
    site.run(1.0, master=RESTING)
    assert (site.state.phase, site.state.waiting) == (Phase.HOLD, True)
    assert site.state.q == held
    assert resume(site) == Accepted()
    site.run(2.0, master=RESTING)
    assert site.result.completed


def test_a_lease_that_ran_out_moves_nothing_when_it_is_renewed(site):
    going(site)
    site.run(1.5, renew=False)
    site.run(2.0)
    assert site.state.hold_reason == f"{ANOTHER_AUTHORITY} (nobody holds the authority)"


def test_nothing_moves_before_anybody_asks():
    site = Site()
    before = site.arm.observation.q.tolist()
    site.run(0.5, master=(0.0, 0.1, 0.0))
    site.acquire()
    site.run(1.0, master=(0.0, 0.1, 0.0))
    assert (list(site.state.q), site.state.phase) == (before, Phase.IDLE)


def test_the_authority_tells_who_holds_it(site):
    site.ask(queries.ACQUIRE, queries.AcquireAuthority("station-1", operator="Ann", take_over=True, reason="it burns"))
    state = site.authority_states.latest().message
    assert (state.operator, state.holder) == ("Ann", "station-1")
    site.run(1.2, renew=False)
    state = site.authority_states.latest().message
    assert (state.operator, state.holder, state.expires_in) == ("", "", 0.0)


def test_short_holds_do_not_stop_progress(site):
    """The ramp and the motion take as long as they would without the holds, but for going on from rest after each."""
    site.execute(Mode.REFINE)
    going_on = holds = total = 0
    while site.state.progress < 1.0:
        goes = total % 40 < 30
        site.run(0.01, master=RESTING, engaged=goes)
        going_on += goes
        holds += total % 40 == 30
        total += 1
        assert total < 1000
    assert going_on == pytest.approx(50 + 100 + holds * 0.5 * EASE_S / 0.01, rel=0.05)


@pytest.mark.parametrize("held", [0.3, 3.0])
@pytest.mark.parametrize("ending", ["finish", "take over"])
def test_a_held_refinement_ends_although_its_master_is_dead(site, ending, held):
    going(site, Mode.REFINE)
    site.run(held)
    where = site.state
    assert where.phase is Phase.HOLD
    if ending == "finish":
        assert site.finish() == Accepted()
    else:
        site.acquire("bob", take_over=True)
    site.run(0.6)
    assert not site.result.completed
    assert ("finished by ann" in site.result.reason) or ("bob took the authority over" in site.result.reason)
    assert (site.state.phase, site.state.waiting, site.state.q) == (Phase.IDLE, False, where.q)


def test_a_finished_episode_ends_although_nobody_is_present(site):
    going(site)
    site.finish()
    site.run(0.6, renew=False)
    assert site.result.reason.startswith("finished by ann at ")
    assert site.state.phase is Phase.IDLE


def test_an_episode_that_was_finished_while_it_went_on_stands_where_it_was(site):
    going(site)
    site.finish()
    standing = site.state.q
    site.run(0.3)
    assert site.state.q == standing


@pytest.mark.parametrize(
    ("displacement", "settled"), [((0.0, 0.02, 0.0), 0.04), ((0.0, 0.04, 0.0), 0.08), ((0.0, 0.0, 0.0), 0.0)]
)
def test_a_gain_does_not_make_the_robot_jump_when_the_clutch_closes(displacement, settled):
    """Whether the master takes the applied offset over, takes it without the gain, or forgets it."""
    site = Site(master_gain=2.0)
    site.acquire()
    site.execute(Mode.REFINE, straight(duration=5.0))
    site.run(1.0, master=RESTING)
    site.run(2.0, master=(0.0, 0.02, 0.0))
    assert site.state.offset[1] == pytest.approx(0.04, abs=1e-5)
    site.run(0.2, master=(0.0, 0.0, 0.0), engaged=False)
    offsets = []
    for _ in range(150):
        site.run(0.01, master=displacement)
        offsets.append(site.state.offset[1])
    assert np.max(np.abs(np.diff([0.04, *offsets]))) < 0.0006
    assert offsets[-1] == pytest.approx(settled, abs=1e-3)


def test_keys_that_are_held_on_the_ramp_do_not_act_at_its_end(site):
    site.execute(Mode.REFINE, straight(duration=2.0))
    for tick in range(100):
        site.run(0.01, master=(0.0, 0.0012 * tick, 0.0))
    assert site.state.phase is Phase.EXECUTE
    assert site.state.offset == RESTING
    site.run(0.1, master=RESTING)
    site.run(1.0, master=(0.0, 0.05, 0.0))
    assert site.state.offset[1] == pytest.approx(0.05, abs=1e-3)
