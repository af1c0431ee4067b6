"""Processes are killed while an empty skill is shown its first motions: it goes on at the place where it was."""

import pytest

from protocol.messages import Mode, Phase, ShowStep
from tests.system.harness import START_S, Command, Witness, configured, free_endpoint

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone, pytest.mark.long]

WITHIN_S = 240.0
PLACES = ((0.67, 0.04), (0.83, 0.22))
"""That the page proposes at the table [m]."""


def test_a_station_and_a_model_that_are_killed_take_no_place_away(tmp_path):
    endpoint = free_endpoint()
    up = ("up", "--fresh", "--untaught", "--headless", "--once", "--scene", "table", "--robot-model", "ur5")
    up += ("--config", configured(tmp_path, endpoint), "--only", "robot,camera,perception,master,model,station")
    with Command(*up, folder=tmp_path) as command, Witness(endpoint) as witness:

        def shows(step, place):
            now = witness.teaching
            return (
                now is not None and now.showing is not None and (now.showing.step, now.showing.place) == (step, place)
            )

        def led():
            robot = witness.robot
            return robot is not None and robot.mode is Mode.TEACH and robot.phase is Phase.EXECUTE

        command.until(lambda: shows(ShowStep.SHOW, 1) and led(), START_S, "the first place is shown")
        command.kill("station")
        command.until(lambda: shows(ShowStep.REPLAY, 1), WITHIN_S, "the first place is seen alone")
        command.kill("model")
        command.until(lambda: shows(ShowStep.SHOW, 2) and led(), WITHIN_S, "the second place is shown")
        command.kill("station")
        command.until(lambda: shows(ShowStep.SHOW, 2), WITHIN_S, "it is the second place still")
        assert command.ended(WITHIN_S) == 0, command.tail()
    seen = [line for line in command.out.splitlines() if "prediction of model version" in line]
    assert all(any(f"object at ({x:.2f}" in line for line in seen) for x, _ in PLACES), command.tail()
