"""What a process says to several robots over one link goes to each by itself."""

import pytest

from protocol.messages import EmergencyStop
from protocol.topics import EMERGENCY_STOP
from tests.system.harness import eventually

pytestmark = pytest.mark.zenoh

WITHIN_S = 20.0


@pytest.mark.parametrize("first", ["kitchen", "garage"])
def test_a_stop_reaches_the_robot_that_it_is_meant_for_whichever_was_stopped_before(join, first):
    stations = {"kitchen": join("kitchen", "station-ann")}
    stations["garage"] = stations["kitchen"].neighbour("garage")
    heard = {robot: join(robot, "robot").subscribe(EMERGENCY_STOP) for robot in stations}

    def stopped(robot):
        stations[robot].publish(EMERGENCY_STOP, EmergencyStop(pressed=True, by=robot))
        return {name for name in heard if robot in {one.message.by for one in heard[name].take()}}

    second = "garage" if first == "kitchen" else "kitchen"
    for robot in (first, second):
        assert eventually(lambda robot=robot: stopped(robot), WITHIN_S, f"the stop of {robot}") == {robot}
    assert all(subscription.drops.misplaced == 0 for subscription in heard.values())
