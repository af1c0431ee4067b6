"""The page listens where it was told to, and says so as a browser understands it."""

import socket
import urllib.request

import pytest

from services.process.clock import SystemClock
from services.process.config import StationSection
from services.station.live_view.description import described
from services.station.page.page import Page
from sim.tasks.scene import Eye

NOTHING = described((), {}, Eye(), None)


def free_port(host):
    try:
        with socket.create_server((host, 0), family=socket.AF_INET6) as probe:
            return probe.getsockname()[1]
    except OSError:
        pytest.skip("this machine has no addresses of version 6")


def test_it_can_be_opened_under_an_address_of_version_6():
    page = Page(StationSection(host="::1", port=free_port("::1")), "robot1", SystemClock(), NOTHING)
    page.start()
    try:
        assert page.url.startswith("http://[::1]:")
        assert urllib.request.urlopen(page.url, timeout=10.0).status == 200
    finally:
        page.close()
