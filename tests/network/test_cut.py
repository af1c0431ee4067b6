"""A link is cut in the middle of a motion: the robot holds, no stop is lost, nothing goes on by itself."""

import time

import numpy as np
import pytest

from tests.network.far_operator import MOTION_S, STRAIGHT_M
from tests.network.operator import Operator
from tests.system.harness import START_S, Command, eventually
from tests.system.onlooker import Onlooker

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

CUT_S = 5.0
SETTLED_S = 1.0
"""After the cut, a robot that holds stands."""

STILL_M = 1e-4
WITHIN_S = 10.0

SHORT_S = 0.005
LONG_S = 0.12
"""Each way; three round trips over the long way take longer than a link over the short one is given to open."""


@pytest.fixture
def moving(link, router, tmp_path):
    """A robot that executes what a far operator asked for, both watched from the robot's side."""
    arguments = ("--scene", "particle", "--insecure", "--connect", router)
    with (
        Command("robot", *arguments, folder=tmp_path),
        Onlooker(router) as onlooker,
        Operator(link, router) as operator,
    ):
        operator.says("executing")
        onlooker.until(lambda seen: seen.phase == "execute" and seen.position[0] > 0.0, START_S, "it moves")
        yield onlooker, operator


def travelled(states):
    """How far the gripper came from the first of the states at most [m]."""
    positions = np.array([seen.position for seen in states])
    return float(np.linalg.norm(positions - positions[0], axis=1).max())


def sleep_until(moment):
    time.sleep(max(0.0, moment - time.monotonic()))


def test_an_autonomous_motion_holds_and_does_not_go_on_by_itself_when_the_link_is_back(link, moving):
    onlooker, _ = moving
    cut = link.cut()
    onlooker.until(lambda seen: seen.phase == "hold" and seen.waiting, WITHIN_S, "it holds, and waits to be asked")
    sleep_until(cut + CUT_S)
    back = link.restore()
    sleep_until(back + CUT_S)

    assert travelled(onlooker.since(cut)) < SETTLED_S * STRAIGHT_M / MOTION_S
    held = onlooker.since(cut + SETTLED_S)
    assert {seen.phase for seen in held} == {"hold"}
    assert travelled(held) < STILL_M
    assert held[-1].at > back + CUT_S / 2, "it was watched to the end"


def test_a_stop_pressed_in_the_middle_of_an_outage_is_latched_before_anything_moves(link, moving):
    onlooker, operator = moving
    cut = link.cut()
    onlooker.until(lambda seen: seen.phase == "hold", WITHIN_S, "it holds")
    sleep_until(cut + CUT_S / 2)
    operator.press()
    sleep_until(cut + CUT_S)
    assert not onlooker.safety["emergency_stop"]
    link.restore()
    eventually(lambda: onlooker.safety["emergency_stop"], WITHIN_S, "the stop is latched")
    operator.says("confirmed")
    onlooker.until(lambda seen: seen.phase == "stopped", WITHIN_S, "it is stopped")

    assert onlooker.safety["by"] == "far"
    after = onlooker.since(cut + SETTLED_S)
    assert {seen.phase for seen in after} <= {"hold", "stopped"}
    assert travelled(after) < STILL_M


def test_a_stop_pressed_in_an_outage_arrives_over_a_way_that_has_become_long(link, router, tmp_path):
    link.shape(delay_s=SHORT_S)
    with (
        Command("robot", "--scene", "particle", "--insecure", "--connect", router, folder=tmp_path),
        Onlooker(router) as onlooker,
        Operator(link, router) as operator,
    ):
        operator.says("executing")
        cut = link.cut()
        onlooker.until(lambda seen: seen.phase == "hold", WITHIN_S, "it holds")
        sleep_until(cut + CUT_S / 2)
        operator.press()
        sleep_until(cut + CUT_S)
        link.shape(cut=False, delay_s=LONG_S)
        eventually(lambda: onlooker.safety["emergency_stop"], START_S, "the stop is latched")
        operator.says("confirmed")
        assert onlooker.safety["by"] == "far"


def test_the_command_line_presses_through_an_outage(link, moving, router, tmp_path):
    onlooker, _ = moving
    cut = link.cut()
    sleep_until(cut + CUT_S / 2)
    with Command(
        "stop", "--operator", "bob", "--insecure", "--connect", router, folder=tmp_path, there=link.there
    ) as stop:
        stop.until(lambda: "NOT confirmed yet" in stop.err, START_S, "it says that nobody has heard it")
        sleep_until(cut + CUT_S)
        link.restore()
        assert stop.ended(START_S) == 0, stop.tail()
    assert "stopped and stands" in stop.err
    eventually(lambda: onlooker.safety["by"] == "bob", WITHIN_S, "the robot tells everybody who stopped it")
    assert travelled(onlooker.since(cut + SETTLED_S)) < STILL_M
