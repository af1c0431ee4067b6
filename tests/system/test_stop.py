"""The stop is pressed and released from the command line."""

import contextlib
import threading

import pytest

from protocol import queries, topics
from protocol.messages import AuthorityRenewal, EmergencyStop, Phase
from services.bus.zenoh import connect
from services.process.clock import SystemClock
from tests.system.harness import Command, Witness, eventually

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.alone]

WITHIN_S = 10.0
ANSWER_S = 30.0


@contextlib.contextmanager
def present(router):
    """A station whose operator is there gets the authority, and renews it: its epoch."""
    bus, over = connect(router, "robot1", "station-ann", SystemClock()), threading.Event()
    asked = bus.ask(queries.ACQUIRE, queries.AcquireAuthority("station", "ann"), ANSWER_S)
    epoch = eventually(asked.poll, ANSWER_S, "the robot gives it the authority").epoch

    def renew():
        while not over.wait(0.02):
            bus.publish(topics.AUTHORITY_RENEWAL, AuthorityRenewal(holder="station", epoch=epoch))

    thread = threading.Thread(target=renew)
    thread.start()
    yield epoch
    over.set()
    thread.join()
    bus.close()


def heard_hz(witness):
    """At which rate the robot hears of the stop [Hz]."""
    beat = witness.next_beats({"robot"})["robot"]
    return next(figures.rate_hz for figures in beat.topics if figures.topic == topics.EMERGENCY_STOP.name)


@pytest.mark.sim
def test_stop_latches_and_release_releases(tmp_path, router):
    with Command("robot", "--connect", router, folder=tmp_path), Witness(router) as witness:
        granted = witness.asked(queries.ACQUIRE, queries.AcquireAuthority("witness"), 30.0)
        with Command("stop", "--operator", "bob", "--connect", router, folder=tmp_path) as stop:
            assert stop.ended(20.0) == 0, stop.tail()
        witness.next(topics.SAFETY_STATE, lambda state: state.emergency_stop)
        witness.next(topics.ROBOT_STATE, lambda state: state.phase is Phase.STOPPED)
        refused = witness.ask(queries.ACQUIRE, queries.AcquireAuthority("witness"))
        assert isinstance(refused, queries.Refused)
        assert "emergency stop" in refused.reason
        # Not pressing any more is no release.
        eventually(lambda: not heard_hz(witness), WITHIN_S, "nobody presses any more")

        def lets_go():
            witness.bus.publish(topics.EMERGENCY_STOP, EmergencyStop(pressed=False, by="witness"))
            return heard_hz(witness)

        eventually(lets_go, WITHIN_S, "the robot hears that it is not pressed")
        assert witness.next(topics.SAFETY_STATE).emergency_stop

        arguments = ("--release", "--operator", "anna", "--connect", router)
        with Command("stop", *arguments, folder=tmp_path) as release:
            assert release.ended(20.0) == 0, release.tail()
        assert "released by anna; bob had pressed it at 20" in release.err
        witness.next(topics.SAFETY_STATE, lambda state: not state.emergency_stop)
        stale = witness.ask(queries.RESET, queries.Reset(granted.epoch))
        assert isinstance(stale, queries.Refused), "who held the authority before has to ask for it again"
        assert witness.asked(queries.ACQUIRE, queries.AcquireAuthority("witness")).epoch > granted.epoch


def test_a_robot_that_does_not_confirm_the_stop_is_named(tmp_path, router):
    with Command("stop", "--timeout", "2", "--robot", "left", "--connect", router, folder=tmp_path) as alone:
        assert alone.ended(20.0) == 3
        assert "stop of robot left NOT confirmed yet: it is not heard" in alone.err
        assert "robot left did not confirm the stop in 2 s" in alone.err


@pytest.mark.sim
def test_one_command_stops_every_robot_and_names_them(tmp_path, router):
    def robot(name):
        return Command("robot", "--scene", "particle", "--robot", name, "--connect", router, folder=tmp_path)

    with robot("left"), robot("right"), Witness(router, "left") as left, Witness(router, "right") as right:
        for witness in (left, right):
            witness.next(topics.SAFETY_STATE, lambda state: not state.emergency_stop)
        with Command("stop", "--all", "--operator", "bob", "--connect", router, folder=tmp_path) as stop:
            assert stop.ended(30.0) == 0, stop.tail()
        assert "all robots that are heard have stopped and stand: left, right" in stop.err
        for witness in (left, right):
            assert witness.next(topics.SAFETY_STATE).emergency_stop


def test_no_robot_at_all_is_not_taken_for_every_one_stopped(tmp_path, router):
    with Command("stop", "--all", "--timeout", "3", "--connect", router, folder=tmp_path) as stop:
        assert stop.ended(20.0) == 3
    assert "no robot is heard" in stop.err


@pytest.mark.sim
def test_a_supervisor_ends_the_authority_of_whoever_commands_from_the_command_line(tmp_path, router):
    arguments = ("--operator", "eve", "--connect", router)
    with Command("robot", "--connect", router, folder=tmp_path), Witness(router) as witness:
        witness.next(topics.SAFETY_STATE)
        with present(router) as epoch:
            with Command("stop", "--revoke", "it is late", *arguments, folder=tmp_path) as revoke:
                assert revoke.ended(20.0) == 0, revoke.tail()
            assert "nobody commands robot robot1 any more: eve revoked ann's authority" in revoke.err
            state = witness.next(topics.AUTHORITY_STATE)
            assert (state.holder, state.by, state.reason) == ("", "eve", "it is late")
            again = witness.ask(queries.RESET, queries.Reset(epoch))
            assert isinstance(again, queries.Refused)
            with Command("stop", "--revoke", "it is late", *arguments, folder=tmp_path) as revoke:
                assert revoke.ended(20.0) == 2
            assert "nothing to revoke" in revoke.err
    with Command("stop", "--revoke", "no", *arguments, folder=tmp_path) as revoke:
        assert revoke.ended(20.0) == 2
    assert "--revoke: give a reason of 3 to 200 characters" in revoke.err
