"""What the robot is asked for: carried out once, under the present authority, or refused in one line."""

import pytest

from protocol import messages, queries
from protocol.messages import Cut, Mode, Phase
from protocol.queries import Accepted, Adapt, EpisodeStarted, Refused
from tests.services.predictions import announce
from tests.services.robot.site import OBSTACLE, Site, straight

RESTING = (0.0, 0.0, 0.0)


@pytest.fixture
def site():
    site = Site()
    site.acquire()
    return site


def test_who_releases_the_authority_leaves_it_to_the_next(site):
    assert site.ask(queries.RELEASE, queries.ReleaseAuthority("ann", site.epoch)) == Accepted()
    assert site.authority_states.latest().message.holder == ""
    site.acquire("bob")


def test_an_authority_is_released_by_its_holder_alone(site):
    refused = site.ask(queries.RELEASE, queries.ReleaseAuthority("eve", site.epoch))
    assert "'eve' does not hold the authority: ann does" in refused.reason


def test_a_prediction_that_nobody_announced_is_refused(site):
    refused = site.ask(queries.EXECUTE, queries.Execute(site.epoch, Mode.AUTONOMOUS, 12345, 1.0))
    assert refused == Refused("no prediction 12345 was heard from the model: predict again")


def test_a_prediction_takes_the_time_that_is_asked_for(site):
    asked = queries.Execute(site.epoch, Mode.AUTONOMOUS, announce(site.operator, straight(duration=9.0)), 1.5)
    assert isinstance(site.ask(queries.EXECUTE, asked), EpisodeStarted)
    site.run(2.6)
    assert site.result.refined.duration == pytest.approx(1.5, abs=0.01)


def test_nothing_else_begins_while_an_episode_runs(site):
    site.execute()
    for refused in (site.ask_to_execute(), site.ask(queries.RESET, queries.Reset(site.epoch))):
        assert refused == Refused("an episode is running: wait for its end, or finish it")


def test_a_finish_is_of_the_present_authority_and_of_something(site):
    assert site.finish() == Refused("no episode is running: nothing to finish")
    site.execute()
    refused = site.ask(queries.FINISH, queries.Finish(site.epoch - 1))
    assert "the command is of epoch" in refused.reason
    assert site.control.arm.episode is not None
    site.run(0.9)
    assert site.finish() == Accepted()
    site.run(0.6)
    assert site.result.reason.startswith("finished by ann at ")
    assert site.result.reason.endswith("%")
    assert site.result.cut is Cut.FINISHED


def test_episodes_are_counted_and_a_result_is_repeated_until_the_next_one(site):
    assert site.execute() == 1
    site.run(2.2)
    assert site.results.latest().message.episode == 1
    assert site.execute() == 2
    site.results.take()
    site.run(1.0)
    assert site.results.take() == []
    site.run(3.5)
    assert {received.message.episode for received in site.results.take()} == {2}


def test_what_a_reset_does_not_name_stays_as_it_was_put_last(site):
    assert site.ask(queries.RESET, queries.Reset(site.epoch, OBSTACLE, condition=(0.1, -0.2))) == Accepted()
    assert site.ask(queries.RESET, queries.Reset(site.epoch)) == Accepted()
    assert (site.arm.variant, site.arm.condition.tolist()) == (OBSTACLE, [0.1, -0.2])


@pytest.mark.parametrize("length", [0.9995, 1.0, 1.0005])
def test_a_start_takes_an_orientation_as_exact_as_the_wire_has_it(site, length):
    start = messages.Pose((0.0, 0.05, 0.0), (length, 0.0, 0.0, 0.0))
    assert site.ask(queries.RESET, queries.Reset(site.epoch, start=start)) == Accepted()
    assert site.arm.start.orientation.tolist() == [1.0, 0.0, 0.0, 0.0]


def test_a_start_that_the_robot_cannot_take_is_refused(site):
    turned = messages.Pose((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    refused = site.ask(queries.RESET, queries.Reset(site.epoch, start=turned))
    assert refused.reason.endswith("the robot does not reach it in that orientation: give another start")


def test_only_a_refinement_is_corrected(site):
    site.execute(Mode.AUTONOMOUS)
    site.run(0.8, master=RESTING)
    site.run(0.2, master=(0.0, 0.05, 0.0))
    assert site.state.offset == RESTING
    site.run(1.5)
    assert not site.result.operator_input


def test_only_a_refinement_needs_a_hand(site):
    site.execute(Mode.AUTONOMOUS)
    site.run(0.8)
    assert site.state.phase is Phase.EXECUTE


@pytest.mark.parametrize(("adapt", "share"), [(Adapt.CURRENT, 1.0), (Adapt.NEXT, 0.5)])
def test_a_correction_moves_the_current_way_point_at_once_and_the_next_one_by_and_by(site, adapt, share):
    asked = queries.Execute(site.epoch, Mode.REFINE, announce(site.operator, straight(duration=2.0)), 2.0, adapt)
    site.ask(queries.EXECUTE, asked)
    site.run(0.6, master=RESTING)
    site.run(0.01, master=(0.0, 0.005, 0.0))
    assert (site.state.offset[1] == pytest.approx(0.005, abs=1e-9)) == (share == 1.0)
    assert site.state.offset[1] > 0.0


def test_keys_that_are_held_on_a_later_ramp_do_not_act_either(site):
    for _ in range(2):
        site.execute(Mode.REFINE)
        site.run(0.3, master=RESTING)
        site.run(0.5, master=(0.0, 0.05, 0.0))
        assert site.state.phase is Phase.EXECUTE
        assert site.state.offset == RESTING
        site.run(0.1, master=RESTING)
        site.run(0.2, master=(0.0, 0.05, 0.0))
        assert site.state.offset[1] > 0.01
        site.run(2.0, master=RESTING)
        assert site.state.phase is Phase.IDLE
        assert site.ask(queries.RESET, queries.Reset(site.epoch)) == Accepted()


def test_an_episode_that_is_over_does_not_wait_to_be_asked(site):
    site.execute()
    site.run(0.8)
    site.run(0.9, renew=False)
    assert site.state.waiting
    assert site.finish() == Accepted()
    assert (site.state.phase, site.state.waiting) == (Phase.HOLD, False)
    assert site.ask(queries.RESUME, queries.Resume(site.epoch)) == Refused(
        "no episode waits to be asked: nothing to go on with"
    )


def test_a_master_that_comes_in_the_place_of_another_starts_from_what_is_applied(site):
    site.execute(Mode.REFINE, straight(duration=3.0))
    site.run(0.8, master=RESTING)
    site.run(0.6, master=(0.0, 0.05, 0.0))
    applied = site.state.offset[1]
    assert applied == pytest.approx(0.05, abs=1e-3)
    site.operator = site.network.bus()
    site.run(0.03, master=(0.0, 0.15, 0.0))
    assert site.state.offset[1] == pytest.approx(applied, abs=0.0015)
