"""A robot's site and an operator's desk: two runs with one file, certificates of one authority, and nothing else."""

import json

import pytest

from services.certificates.authority import make_authority
from tests.ports import free_port
from tests.system.closed import check_closed
from tests.system.harness import START_S, Command

pytestmark = [pytest.mark.system, pytest.mark.alone]

LOOP_S = 240.0

SITE = ("router.kitchen", "robot.kitchen", "camera.kitchen", "perception.kitchen", "model.kitchen")


@pytest.fixture
def network(tmp_path):
    """The file that both have, and a folder for each."""
    port, own = free_port(), free_port()
    authority = make_authority(tmp_path / "authority")
    for name in ("operator.anna", "router.desk"):
        authority.issue(name, to=tmp_path / "desk" / "certs")
    for name in SITE:
        authority.issue(name, hosts=("127.0.0.1",) * name.startswith("router"), to=tmp_path / "site" / "certs")
    (tmp_path / "network.toml").write_text(
        f"""
        name = "kitchen"
        listen = "tcp/127.0.0.1:{own}"
        tls = "certs"
        [site]
        listen = "tls/127.0.0.1:{port}"
        [desk]
        connect = "tls/127.0.0.1:{port}"
        router = true
        [viewer]
        web_port = {free_port()}
        stream_port = {free_port()}
        [station]
        port = {free_port()}
        """
    )
    return tmp_path


def test_the_loop_closes_between_them(network):
    configured = ("--config", network / "network.toml")
    with (
        Command("up", "--site", *configured, folder=network / "site") as site,
        Command(
            "up", "--desk", "--headless", "--once", "--operator", "anna", "--json", "said.json", *configured,
            folder=network / "desk",
        ) as desk,
    ):  # fmt: skip
        site.until(lambda: "robot" in site.pids(), START_S, "the robot's process is there")
        assert desk.ended(LOOP_S) == 0, f"{desk.tail()}\n{site.tail()}"
        said = json.loads((network / "desk" / "said.json").read_text())
        check_closed(said, "dishwasher")
        assert set(said["processes"]) == {"router", "master", "viewer", "station"}
        assert set(site.pids()) == {"router", "robot", "camera", "perception", "model"}
        assert site.stop() == 0
    log = Command("log", "show", "--robot", "kitchen", folder=network / "site")
    with log:
        assert log.ended(START_S) == 0, log.tail()
    assert "anna has the authority" in log.out
    assert "corrected by anna" in log.out
