"""The router's settings in a file do for Zenoh's own what the router does for us."""

import json

import pytest
import zenoh

from protocol import topics
from services import cli
from services.bus.zenoh import connect
from services.certificates.authority import make_authority
from services.certificates.credentials import credentials
from services.process.clock import SystemClock
from services.process.config import Configuration
from tests.heartbeats import heartbeat
from tests.ports import free_port
from tests.system.harness import eventually

pytestmark = pytest.mark.zenoh

WITHIN_S = 20.0


@pytest.fixture
def folder(tmp_path):
    authority = make_authority(tmp_path / "certs")
    for name in ("camera.kitchen", "operator.anna", "camera.garage"):
        authority.issue(name)
    authority.issue("router.kitchen", hosts=("127.0.0.1",))
    return tmp_path / "certs"


@pytest.fixture
def endpoint(folder, tmp_path, capsys):
    """Of a router of Zenoh's own, which has nothing but the file."""
    listen = f"tls/127.0.0.1:{free_port()}"
    assert cli.main(["router", "--robot", "kitchen", "--tls", str(folder), "--listen", listen, "--print"]) == 0
    file = tmp_path / "zenohd.json5"
    file.write_text(capsys.readouterr().out)
    router = zenoh.open(zenoh.Config.from_file(str(file)))
    yield listen
    router.close()


def test_it_lets_in_whom_the_certificates_name_and_passes_on_what_they_may_say(folder, endpoint):
    configuration = Configuration(name="kitchen", operator="anna", connect=endpoint, tls=str(folder))
    camera = connect(
        endpoint, "kitchen", "camera", SystemClock(), credentials=credentials(configuration, endpoint, "camera")
    )
    station = connect(
        endpoint, "kitchen", "station-anna", SystemClock(), credentials=credentials(configuration, endpoint, "station")
    )
    try:
        heard = station.subscribe(topics.HEARTBEAT)

        def passed():
            camera.publish(topics.HEARTBEAT, heartbeat("camera"))
            return heard.latest() is not None

        eventually(passed, WITHIN_S, "a camera is heard through it")
    finally:
        camera.close()
        station.close()


def test_the_file_says_who_may_do_what(folder, capsys):
    listen = "tls/127.0.0.1:7447"
    assert cli.main(["router", "--robot", "kitchen", "--tls", str(folder), "--listen", listen, "--print"]) == 0
    made = json.loads(capsys.readouterr().out)
    assert made["access_control"]["default_permission"] == "deny"
    assert made["transport"]["link"]["tls"]["enable_mtls"]


def test_a_router_of_this_machine_alone_needs_no_certificates(capsys):
    assert cli.main(["router", "--print"]) == 0
    made = json.loads(capsys.readouterr().out)
    assert made["mode"] == "router"
    assert "access_control" not in made
