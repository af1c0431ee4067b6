"""Shared by the tests of what brings a lost link back."""

import pytest

from services.bus.zenoh import connect, open_router
from services.process.clock import SystemClock
from tests.ports import free_port


@pytest.fixture
def soon(monkeypatch):
    """What is waited for in a real outage is waited for shortly."""
    monkeypatch.setattr("services.bus.zenoh.redialling.LOOK_S", 0.05)
    monkeypatch.setattr("services.bus.zenoh.redialling.OWN_ATTEMPTS", 0.5)


@pytest.fixture
def router():
    """The port of one."""
    port = free_port()
    opened = open_router(f"tcp/127.0.0.1:{port}")
    yield port
    opened.close()


@pytest.fixture
def join(router):
    """A function that lets a process join the router's network."""
    opened = []

    def one(robot, process, endpoint=f"tcp/127.0.0.1:{router}"):
        opened.append(connect(endpoint, robot, process, SystemClock()))
        return opened[-1]

    yield one
    for bus in opened:
        bus.close()
