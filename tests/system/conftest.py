"""What the system tests share."""

import pytest

from services.bus.zenoh import connect
from services.process.clock import SystemClock
from tests.system.exposed import exposed, nothing_changes
from tests.system.harness import Command, free_endpoint, reachable


@pytest.fixture(scope="module")
def router(tmp_path_factory):
    """The endpoint of a real router."""
    endpoint = free_endpoint()
    with Command("router", "--listen", endpoint, folder=tmp_path_factory.mktemp("router")) as command:
        command.until(lambda: reachable(endpoint), 20.0, "the router listens")
        yield endpoint


@pytest.fixture
def bus(router):
    """A function that opens the bus of another process."""
    opened = []

    def open_one(process, robot="robot1"):
        opened.append(connect(router, robot, process, SystemClock()))
        return opened[-1]

    yield open_one
    for one in opened:
        one.close()


@pytest.fixture(scope="module")
def network(tmp_path_factory):
    """A whole system, exposed to whatever comes."""
    with exposed(tmp_path_factory.mktemp("exposed")) as network:
        yield network


@pytest.fixture
def unmoved(network):
    """The heartbeats from before; nothing may change meanwhile."""
    with nothing_changes(network) as before:
        yield before
