"""Nothing moves unasked, as a foreign client of the network sees it: a whole system with nobody at its page."""

import os
import signal
import time

import pytest

from tests.system.harness import EVERYBODY, START_S, Command, Witness, configured, eventually, free_endpoint
from tests.system.onlooker import STANDING, Onlooker

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

WATCHED_S = 3.0
CUT_S = 3.0
BACK_S = 30.0
KILLS = 3


@pytest.fixture(scope="module")
def endpoint():
    return free_endpoint()


@pytest.fixture(scope="module")
def up(tmp_path_factory, endpoint):
    """The whole system, nobody there."""
    folder = tmp_path_factory.mktemp("unasked")
    arguments = ("--fresh", "--no-browser", "--scene", "particle", "--config", configured(folder, endpoint))
    with Command("up", *arguments, folder=folder) as command:
        with Witness(endpoint) as witness:
            witness.next_beats(EVERYBODY - {"router"}, START_S)
        yield command


@pytest.fixture(scope="module")
def onlooker(up, endpoint):
    with Onlooker(endpoint) as watching:
        yield watching


def pressed(endpoint, folder, *arguments):
    """`retouch stop`, and its good end."""
    with Command("stop", *arguments, "--connect", endpoint, folder=folder) as stop:
        assert stop.ended(START_S) == 0, stop.tail()


def killed(up, name):
    """kill -9, and the wait until it is another process."""
    before = up.kill(name)
    up.until(lambda: up.pids().get(name, before) != before, BACK_S, f"{name} starts again")


def test_with_nobody_there_the_robot_stands(onlooker):
    assert onlooker.phases_of(2 * WATCHED_S) <= STANDING


def test_it_stands_when_the_stop_is_released(onlooker, endpoint, tmp_path):
    pressed(endpoint, tmp_path)
    onlooker.until(lambda seen: seen.phase == "stopped", BACK_S, "it is stopped")
    pressed(endpoint, tmp_path, "--release")
    onlooker.until(lambda seen: seen.phase != "stopped", BACK_S, "it is released")
    assert onlooker.phases_of(WATCHED_S) <= STANDING


@pytest.mark.parametrize("name", ["station", "router", "robot"])
def test_it_stands_when_a_process_was_killed_and_is_back(up, onlooker, name):
    killed(up, name)
    assert onlooker.phases_of(WATCHED_S) <= STANDING


def test_it_stands_when_the_network_was_silent_for_seconds(up, onlooker):
    router = up.pids()["router"]
    os.kill(router, signal.SIGSTOP)
    time.sleep(CUT_S)
    os.kill(router, signal.SIGCONT)
    assert onlooker.phases_of(WATCHED_S) <= STANDING


def test_a_latched_stop_outlives_the_robots_process(up, onlooker, endpoint, tmp_path):
    pressed(endpoint, tmp_path, "--operator", "anna")
    for _ in range(KILLS):
        killed(up, "robot")
        onlooker.safety.clear()
        assert onlooker.phases_of(1.0) == {"stopped"}
        safety = eventually(lambda: onlooker.safety, BACK_S, "its safety state is heard")
        assert safety["emergency_stop"]
        assert safety["by"] == "anna"
    pressed(endpoint, tmp_path, "--release")
    onlooker.until(lambda seen: seen.phase == "idle", BACK_S, "it is released")
