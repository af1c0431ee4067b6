"""What the tests of the services share."""

from functools import partial

import pytest

from services.process.config import StationSection


@pytest.fixture
def hurried(monkeypatch):
    """Rehearsals whose episodes take less time: less to simulate, and enough for the scripted operator."""
    section = partial(StationSection, autonomous_s=4.0, refine_s=8.0)
    monkeypatch.setattr("services.offline.rehearsal.StationSection", section)
