"""What the system tests share."""

import pytest

from tests.system.harness import Command, free_endpoint, reachable


@pytest.fixture(scope="module")
def router(tmp_path_factory):
    """The endpoint of a real router."""
    endpoint = free_endpoint()
    with Command("router", "--listen", endpoint, folder=tmp_path_factory.mktemp("router")) as command:
        command.until(lambda: reachable(endpoint), 20.0, "the router listens")
        yield endpoint
