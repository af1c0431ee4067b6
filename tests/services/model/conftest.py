"""A model process of its own for each test."""

import pytest

from tests.services.model.rig import Rig


@pytest.fixture
def path(tmp_path):
    return tmp_path / "model.sqlite"


@pytest.fixture
def rig(path):
    rig = Rig(path)
    yield rig
    rig.service.close()
