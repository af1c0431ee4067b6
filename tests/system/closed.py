"""What a report has to say of a run in which the loop has closed, and its recording."""

import subprocess
from pathlib import Path

import pytest

from services.viewer.web_files import sdk_program

SAME_PLACE_M = 0.02


def succeeded(attempt):
    verdict = attempt["verdict"]
    return verdict["reached"] and not verdict["kicked_over"] and not verdict["collision"]


def check_closed(report, scene):
    """A prediction failed, was refined, and the next one succeeded by itself, at one place; it was recorded."""
    assert report["loop_closed"] is True
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
