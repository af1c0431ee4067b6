"""Shared by the tests of what brings a lost link back."""

import pytest


@pytest.fixture
def soon(monkeypatch):
    """What is waited for in a real outage is waited for shortly."""
    monkeypatch.setattr("services.bus.zenoh.redialling.LOOK_S", 0.05)
    monkeypatch.setattr("services.bus.zenoh.redialling.OWN_ATTEMPTS", 0.5)
