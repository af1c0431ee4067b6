"""What the tests on a bad network share."""

import pytest

from services.bus.zenoh import open_router
from tests.network.identities import Identities
from tests.network.link import Impossible, Link
from tests.ports import free_port
from tests.system.harness import Command, reachable


@pytest.fixture(scope="module")
def identities(tmp_path_factory):
    """Certificates of everybody, and what forgers have."""
    return Identities(tmp_path_factory.mktemp("identities"))


@pytest.fixture(scope="module")
def endpoint(identities):
    """Of a router that lets in who shows a certificate."""
    endpoint = f"tls/127.0.0.1:{free_port()}"
    router = open_router(endpoint, None, identities.of("router.kitchen"))
    yield endpoint
    router.close()


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
