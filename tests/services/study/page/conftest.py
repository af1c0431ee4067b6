"""A study at three points, with a stand-in for the robot."""

import pytest

from services.study.page import acts
from tests.services.study.page.acting import agree, begin, fill
from tests.study_harness import Served


@pytest.fixture
def study(tmp_path):
    made = Served(tmp_path / "raw", 0, "http://127.0.0.1:1/")
    made.desk.console_does(acts.Enrol(number=1, language="en"))
    yield made
    made.journal.close()


@pytest.fixture
def ready(study):
    """A study whose participant is before the first training."""
    agree(study)
    fill(study)
    return study


@pytest.fixture
def resting(ready):
    """A study whose participant has a break."""
    for _ in range(3):
        begin(ready)
        ready.trials.finish()
    fill(ready)
    fill(ready)
    return ready
