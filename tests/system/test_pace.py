"""A press on the page slows a real robot's motion down, pauses it, leads it back and on again."""

import time

import pytest

from protocol import topics
from services.process.config import load
from services.station.workflow.going import STEP
from tests.system.harness import START_S, Command, Witness, configured, eventually, free_endpoint
from tests.system.somebody import Somebody

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.alone]

WITHIN_S = 60.0
AGAIN_S = 5.0


def test_a_motion_pauses_goes_back_and_comes_to_its_end(tmp_path):
    endpoint = free_endpoint()
    configuration = configured(tmp_path, endpoint)
    station = load(configuration).station
    with (
        Command(
            "up", "--fresh", "--no-browser", "--scene", "particle", "--config", configuration, folder=tmp_path
        ) as up,
        Witness(endpoint) as witness,
        Somebody(station.host, station.port) as somebody,
    ):
        execution = witness.bus.subscribe(topics.EXECUTION)

        def until(seen):
            return eventually(seen, WITHIN_S, up.tail)

        def goes(pace):
            """Whether the motion under way is to go like that."""
            newest = execution.latest()
            return newest is not None and newest.message.pace == pace

        def offers(action):
            return witness.teaching is not None and action in witness.teaching.actions

        def press(action, seen):
            """Press it once it is offered, and again where a busy machine did not let it count, until `seen()`."""
            due_s = 0.0

            def pressed():
                nonlocal due_s
                if time.monotonic() > due_s and offers(action):
                    somebody.press(action)
                    due_s = time.monotonic() + AGAIN_S
                return seen()

            until(pressed)

        eventually(lambda: offers("execute"), START_S, up.tail)
        press("execute", lambda: offers("pause"))
        until(lambda: witness.robot is not None and witness.robot.progress > 2 * STEP)
        press("pause", lambda: goes(0.0) and offers("play"))
        paused = witness.next(topics.ROBOT_STATE, lambda state: not any(state.qd)).progress
        assert 0.0 < paused < 1.0
        somebody.press("step_back")
        until(lambda: witness.robot is not None and witness.robot.progress < paused - 0.9 * STEP and goes(0.0))
        assert witness.next(topics.ROBOT_STATE).progress == pytest.approx(paused - STEP, abs=0.005)
        press("play", lambda: goes(1.0))
        attempt = until(lambda: witness.teaching is not None and witness.teaching.attempts)
        assert attempt[0].number == 1
        assert not attempt[0].operator_input
