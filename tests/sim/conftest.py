"""What the tests of the simulated world share."""

import pytest

from sim.robots.description import RobotDescription, prepare


@pytest.fixture(scope="session")
def description(tmp_path_factory: pytest.TempPathFactory) -> RobotDescription:
    return prepare(tmp_path_factory.mktemp("cache"))
