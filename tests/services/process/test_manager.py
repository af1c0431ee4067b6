"""What systemd is told, on a real socket as it makes one."""

import os
import socket

import pytest

from services.process.manager import PATIENCE, SOCKET, Manager

SECOND = 1_000_000_000


@pytest.fixture(params=["file", "abstract"])
def told(request, tmp_path, monkeypatch):
    """A function that reads what was said since."""
    name = str(tmp_path / "notify") if request.param == "file" else f"@retouch-{os.getpid()}"
    monkeypatch.setenv(SOCKET, name)
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
        manager.bind(f"\0{name[1:]}" if name.startswith("@") else name)
        manager.setblocking(False)

        def read():
            lines = []
            try:
                while True:
                    lines.append(manager.recv(4096).decode())
            except BlockingIOError:
                return lines

        yield read


def test_it_is_told_once_that_everything_is_there(told):
    manager = Manager()
    manager.ready()
    manager.ready()
    manager.stopping()
    assert told() == ["READY=1", "STOPPING=1"]


def test_signs_of_life_come_three_times_in_its_patience(told, monkeypatch):
    monkeypatch.setenv(PATIENCE, "15000000")
    manager = Manager()
    heard = []
    for second in range(61):
        manager.alive(second * SECOND)
        heard += [second] * len(told())
    assert heard == list(range(0, 61, 5))


def test_without_a_watchdog_there_are_none(told):
    manager = Manager()
    manager.alive(0)
    assert told() == []


@pytest.mark.usefixtures("told")
def test_what_is_started_from_here_does_not_speak_for_it(monkeypatch):
    monkeypatch.setenv(PATIENCE, "15000000")
    Manager()
    assert SOCKET not in os.environ
    assert PATIENCE not in os.environ


@pytest.mark.parametrize("address", ["", "/no/such/folder/notify"])
def test_nobody_who_listens_is_no_reason_to_fail(address, monkeypatch):
    monkeypatch.setenv(SOCKET, address)
    manager = Manager()
    manager.ready()
    manager.stopping()
