"""Shared by the tests of a study."""

import pytest


@pytest.fixture
def unsynchronised(monkeypatch):
    """Where nothing is about power cuts, thousands of entries do not wait for the disk."""
    monkeypatch.setattr("services.study.journal.os.fsync", lambda _: None)
