"""What the tests on a bad network share."""

import pytest

from tests.network.link import Impossible, Link
from tests.ports import free_port
from tests.system.harness import Command, reachable


@pytest.fixture
def link():
    """A link to a far machine."""
    try:
        entered = Link().__enter__()
    except Impossible as reason:
        pytest.skip(str(reason))
    yield entered
    entered.__exit__()


@pytest.fixture
def router(link, tmp_path):
    """The endpoint of a router on this machine, for both sides."""
    endpoint = f"tcp/{link.near}:{free_port()}"
    with Command("router", "--insecure", "--listen", endpoint, folder=tmp_path) as command:
        command.until(lambda: reachable(endpoint), 30.0, "the router listens")
        yield endpoint
