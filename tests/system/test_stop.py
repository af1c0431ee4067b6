"""The stop is pressed and released from the command line."""

import pytest

from protocol import queries, topics
from protocol.messages import EmergencyStop, Phase
from tests.system.harness import Command, Witness, eventually

pytestmark = [pytest.mark.system, pytest.mark.zenoh]

WITHIN_S = 10.0


@pytest.mark.sim
def test_stop_latches_and_release_releases(tmp_path, router):
    with Command("robot", "--connect", router, folder=tmp_path), Witness(router) as witness:
        granted = witness.asked(queries.ACQUIRE, queries.AcquireAuthority("witness"), 30.0)
        with Command("stop", "--operator", "bob", "--connect", router, folder=tmp_path) as stop:
            assert stop.ended(20.0) == 0, stop.tail()
        eventually(lambda: witness.safety and witness.safety.emergency_stop, WITHIN_S, "the stop has latched")
        eventually(lambda: witness.robot.phase is Phase.STOPPED, WITHIN_S, "the robot says so")
        refused = witness.ask(queries.ACQUIRE, queries.AcquireAuthority("witness"))
        assert isinstance(refused, queries.Refused)
        assert "emergency stop" in refused.reason
        # Not pressing any more is no release.
        witness.bus.publish(topics.EMERGENCY_STOP, EmergencyStop(pressed=False, by="witness"))
        witness.next_beats({"robot"})
        assert witness.safety.emergency_stop

        arguments = ("--release", "--operator", "anna", "--connect", router)
        with Command("stop", *arguments, folder=tmp_path) as release:
            assert release.ended(20.0) == 0, release.tail()
        assert "released by anna; bob had pressed it at 20" in release.err
        eventually(lambda: witness.safety and not witness.safety.emergency_stop, WITHIN_S, "the stop is released")
        stale = witness.ask(queries.RESET, queries.Reset(granted.epoch))
        assert isinstance(stale, queries.Refused), "who held the authority before has to ask for it again"
        assert witness.asked(queries.ACQUIRE, queries.AcquireAuthority("witness")).epoch > granted.epoch


def test_a_robot_that_does_not_confirm_the_stop_is_named(tmp_path, router):
    with Command("stop", "--timeout", "2", "--robot", "left", "--connect", router, folder=tmp_path) as alone:
        assert alone.ended(20.0) == 3
        assert "stop of robot left NOT confirmed yet: it is not heard" in alone.err
        assert "robot 'left' did not confirm the stop in 2 s" in alone.err
