"""A stop is latched, kept and confirmed; nothing moves until it is released and somebody asks again."""

from datetime import timedelta

import pytest

from protocol import messages, queries, topics
from protocol.messages import Cut, Mode, Phase
from protocol.queries import Accepted, EpisodeStarted, Refused
from services.robot.memory import SafetyFile
from tests.services.robot.site import MORNING, AtOnce, Later, Site, straight


@pytest.fixture
def path(tmp_path):
    return tmp_path / "robot1" / "safety.json"


def site_with(path, executor=None, morning=MORNING):
    return Site(SafetyFile(path, executor or AtOnce()), morning=morning)


def test_a_stop_latches_with_who_why_and_when_and_stands():
    site = Site()
    site.acquire()
    site.execute()
    site.run(1.0)
    before = site.state.q
    site.press("bob", "smoke")
    assert site.state.phase is Phase.STOPPED
    state = site.safety
    assert (state.emergency_stop, state.by, state.reason, state.standing) == (True, "bob", "smoke", True)
    assert state.at == site.utc().isoformat(timespec="seconds")
    assert state.released_by == ""
    site.run(0.5)
    assert site.state.q == before


def test_a_stop_is_not_shown_as_standing_while_a_joint_moves():
    site = Site()
    site.acquire()
    site.execute()
    site.run(1.0)
    assert not site.safety.standing
    site.run(1.5)
    assert site.safety.standing


def test_a_stopped_episode_is_not_completed():
    site = Site()
    site.acquire()
    site.execute()
    site.run(1.0)
    site.press("bob", "smoke")
    assert (site.result.completed, site.result.reason) == (False, "emergency stop by bob: smoke")
    assert site.result.cut is Cut.STOPPED


def test_a_stop_while_a_success_settles_is_a_stop():
    site = Site()
    site.acquire()
    site.execute()
    site.run(0.5 + 1.0 + 0.3)
    assert site.state.progress == 1.0
    assert site.result is None
    site.press("bob", "smoke")
    assert site.result.verdict.reached
    assert (site.result.completed, site.result.reason) == (False, "emergency stop by bob: smoke")
    assert site.result.cut is Cut.STOPPED


def test_nothing_is_carried_out_while_the_stop_is_latched():
    site = Site()
    site.acquire()
    site.press("bob", "smoke")
    for refused in (
        site.ask_to_execute(),
        site.ask(queries.RESET, queries.Reset(site.epoch)),
        site.ask(queries.ACQUIRE, queries.AcquireAuthority("ann", take_over=True, reason="it burns")),
    ):
        assert isinstance(refused, Refused)
        assert refused.reason == "emergency stop by bob: smoke: release it first"


def test_a_press_that_is_repeated_commands_nothing_new():
    site = Site()
    site.press("bob", "smoke")
    stopped = []
    site.arm.stop = stopped.append
    site.press("eve", "too")
    assert stopped == []
    assert site.safety.by == "bob"


def test_a_button_that_is_not_pressed_stops_nothing():
    site = Site()
    site.operator.publish(topics.EMERGENCY_STOP, messages.EmergencyStop(pressed=False, by="bob"))
    site.run(0.05)
    assert not site.safety.emergency_stop


def test_a_stop_is_heard_among_what_a_flood_brings_in_a_control_period():
    site = Site()
    site.operator.publish(topics.EMERGENCY_STOP, messages.EmergencyStop(pressed=True, by="bob", reason="smoke"))
    for _ in range(200):  # twenty thousand a second
        site.operator.publish(topics.EMERGENCY_STOP, messages.EmergencyStop(pressed=False, by="eve"))
    site.run(0.05)
    assert (site.safety.emergency_stop, site.safety.by) == (True, "bob")


def test_a_release_names_who_and_when_takes_the_authority_and_moves_nothing():
    site = Site()
    site.acquire()
    site.execute()
    site.run(1.0)
    site.press()
    before, epoch = site.state.q, site.epoch
    assert site.release("eve") == Accepted()
    assert (site.safety.emergency_stop, site.safety.released_by) == (False, "eve")
    assert site.safety.at == site.utc().isoformat(timespec="seconds")
    assert "nobody holds the authority" in site.ask_to_execute().reason
    site.run(1.0, master=(0.0, 0.1, 0.0))
    assert (site.state.q, site.state.phase) == (before, Phase.IDLE)
    assert site.acquire() > epoch + 1
    site.run(1.0, master=(0.0, 0.1, 0.0))
    assert (site.state.q, site.state.phase) == (before, Phase.IDLE)
    assert isinstance(site.ask_to_execute(), EpisodeStarted)


def test_only_a_latched_stop_is_released_and_only_by_somebody():
    site = Site()
    assert "not latched" in site.release().reason
    site.press()
    assert "needs a name" in site.release("").reason
    assert site.safety.emergency_stop


def test_a_stop_is_latched_still_when_the_process_comes_back(path):
    site_with(path).press("bob", "smoke")
    site = site_with(path)
    site.run(0.02)
    assert site.state.phase is Phase.STOPPED
    assert (site.safety.emergency_stop, site.safety.by, site.safety.reason) == (True, "bob", "smoke")
    assert "smoke" in site.ask(queries.ACQUIRE, queries.AcquireAuthority("ann")).reason
    assert site.safety.earlier
    site.release()
    assert not site_with(path).control.latch.latched


def test_what_was_released_before_the_process_began_is_told_as_such(path):
    site = site_with(path)
    site.run(0.02)
    assert not site.safety.earlier, "there was nothing"
    site.press("bob", "smoke")
    site.release("carl")
    site.run(0.02)
    assert (site.safety.released_by, site.safety.earlier) == ("carl", False)
    later = site_with(path)
    later.run(0.02)
    assert (later.safety.released_by, later.safety.earlier) == ("carl", True)
    later.press("eve", "fire")
    assert not later.safety.earlier


def test_the_arm_stands_before_the_file_is_written_and_the_stop_shows_only_then(path):
    disk = Later()
    site = site_with(path, disk)
    site.acquire()
    site.execute()
    site.run(1.0)
    disk.catch_up()
    site.press()
    standing = site.state.q
    site.run(0.3)
    assert (site.state.phase, site.state.q) == (Phase.STOPPED, standing)
    assert not site.safety.emergency_stop
    disk.catch_up()
    site.run(0.01)
    assert site.safety.emergency_stop


def test_a_stop_works_where_nothing_can_be_written_and_says_so(path):
    path.parent.parent.joinpath("robot1").write_text("a file where the folder should be")
    site = Site(SafetyFile(path, AtOnce()))
    # What is there cannot be read either: the safe side.
    site.run(0.02)
    assert site.safety.emergency_stop
    assert "cannot be written" in site.safety.reason
    site.release()
    site.acquire()
    site.execute()
    site.run(1.0)
    site.press("bob", "smoke")
    assert site.state.phase is Phase.STOPPED
    assert site.safety.emergency_stop
    assert site.safety.reason.startswith("smoke; the stop would not outlive this process")


def test_no_epoch_is_given_out_twice_whatever_becomes_of_process_clock_and_file(path):
    given = []
    for _ in range(3):
        site = site_with(path)
        given += [site.acquire(), site.acquire()]
    path.unlink()
    given.append(site_with(path, morning=MORNING + timedelta(minutes=1)).acquire())
    assert given == sorted(set(given))


def test_the_epoch_grows_although_the_time_of_day_was_set_back(path):
    last = site_with(path).acquire()
    second = site_with(path, morning=MORNING.replace(year=1970))
    assert second.acquire() > last


@pytest.mark.parametrize("mode", Mode)
def test_a_stop_ends_a_held_episode_whoever_is_dead(mode):
    site = Site()
    site.acquire()
    site.execute(mode)
    site.run(1.5, renew=False)
    assert site.state.phase is Phase.HOLD
    site.press()
    assert site.state.phase is Phase.STOPPED
    assert not site.result.completed


def test_the_longest_texts_fit_into_everything_that_repeats_them():
    site = Site()
    site.acquire("\U0001f9be" * 64)
    site.execute(motion=straight())
    site.run(1.0)
    site.press("\U0001f9be" * 64, "\U0001f9be" * 1500)
    assert site.safety.emergency_stop
    assert site.result.reason.startswith("emergency stop by")
    refused = site.ask(queries.ACQUIRE, queries.AcquireAuthority("\U0001f9be" * 64))
    assert isinstance(refused, Refused)
