"""kill -9 of any process of a synthetic study, again and again: no trial is lost, none twice, the data are the same."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from services.study.events import Opened, Repaired
from services.study.journal import read
from services.study.study import new_study
from tests.study_harness import PROTOCOL

pytestmark = [pytest.mark.system, pytest.mark.long]

KILLS = 30
LONGEST_S = 300.0
"""Of a run that nobody kills."""


SHORT = {
    'teaching = "waypoints"\ndevice = "keyboard"': 'teaching = "prediction"\ndevice = "stylus"',
    "[task]\nmodels = 2": '[task]\nscene = "particle"\nmodels = 1\n\n[training]\nsuccesses = 1\nof_last = 1',
}
"""What makes a study short to act: both methods correct a motion in the plane."""


@pytest.fixture
def small(tmp_path):
    """A function that makes one."""
    text = PROTOCOL.read_text(encoding="utf-8")
    for long, short in SHORT.items():
        assert long in text
        text = text.replace(long, short)
    template = tmp_path / "protocol.toml"
    template.write_text(text, encoding="utf-8")
    return lambda name: new_study(tmp_path / name, template).folder


def started(folder):
    command = [sys.executable, "-I", "-m", "services", "study", "run", str(folder), "--synthetic", "2", "--headless"]
    return subprocess.Popen([*command, "--jobs", "2"], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)


def processes(parent):
    """A process and all that it has started."""
    children = Path(f"/proc/{parent}/task/{parent}/children").read_text().split()
    return [parent, *(each for child in children for each in processes(int(child)))]


def events(folder):
    return [entry.event for entry in read(folder / "raw") if not isinstance(entry.event, Opened | Repaired)]


def test_thirty_kills_lose_and_repeat_no_trial(small):
    calm, killed = small("calm"), small("killed")
    assert started(calm).wait(LONGEST_S) == 0
    rng = np.random.default_rng(30)
    for _ in range(KILLS):
        run = started(killed)
        time.sleep(rng.uniform(0.5, 25.0))  # the moment is what is drawn
        if run.poll() is None:
            os.kill(int(rng.choice(processes(run.pid))), signal.SIGKILL)
        time.sleep(1.0)
        run.kill()
        run.wait()
    assert started(killed).wait(LONGEST_S) == 0
    assert events(killed) == events(calm)
