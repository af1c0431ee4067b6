"""The whole product: one command closes the loop, and says so to people and to programs."""

import json
import subprocess
from pathlib import Path

import pytest

from services.viewer.web_files import sdk_program
from tests.system.harness import EVERYBODY, Command, configured, free_endpoint

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

WITHIN_S = 240.0
SAME_PLACE_M = 0.02


def succeeded(attempt):
    verdict = attempt["verdict"]
    return verdict["reached"] and not verdict["kicked_over"] and not verdict["collision"]


LONG = ("particle", "table", "post")


@pytest.mark.parametrize("scene", ["dishwasher", *(pytest.param(scene, marks=pytest.mark.long) for scene in LONG)])
def test_a_prediction_fails_is_refined_and_the_next_one_succeeds_by_itself(tmp_path, scene):
    configuration = configured(tmp_path, free_endpoint())
    arguments = ("--fresh", "--headless", "--once", "--scene", scene, "--json", "out.json", "--config", configuration)
    with Command("up", *arguments, folder=tmp_path) as up:
        assert up.ended(WITHIN_S) == 0, up.tail()
        assert up.left() == []
    report = json.loads((tmp_path / "out.json").read_text())

    assert report["loop_closed"] is True
    assert set(report["processes"]) == EVERYBODY
    assert len(set(report["processes"].values())) == len(EVERYBODY)
    assert not any(report["restarts"].values())

    attempts = report["attempts"]
    first, *later = attempts
    assert not first["operator_input"]
    assert first["verdict"]["collision"]
    refined = next(attempt for attempt in later if attempt["operator_input"] and succeeded(attempt))
    last = attempts[-1]
    assert not last["operator_input"]
    assert succeeded(last)
    assert last["model_version"] > refined["model_version"]
    for attempt in attempts:
        assert attempt["scene"] == scene
        assert attempt["duration_s"] > 0.0
        assert attempt["object_position"] == pytest.approx(first["object_position"], abs=SAME_PLACE_M)
        assert attempt["condition"] == first["condition"]

    recording = Path(report["recording"])
    assert recording.suffix == ".rrd"
    verified = subprocess.run(
        [sdk_program(), "rrd", "verify", recording], capture_output=True, text=True, timeout=60.0, check=False
    )
    assert verified.returncode == 0, verified.stderr
