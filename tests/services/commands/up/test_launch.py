"""What `retouch up` starts follows from its arguments."""

import re
import socket
from pathlib import Path

import pytest

from services.cli import parser
from services.commands.settings import configuration
from services.commands.sides import reachable
from services.commands.up.launch import TEACHER, Launch, _jobs, check_ports
from services.process.config import Configuration, StationSection, ViewerSection
from services.process.exceptions import CommandFailed, EndpointInUse, PortInUse
from services.process.master_devices import Page, Scripted
from services.process.processes import PROCESS_NAMES
from sim.exceptions import SimError


def arguments(*words):
    return parser().parse_args(["up", *words])


def launch(*words):
    given = arguments(*words)
    return Launch.from_arguments(given, configuration(given))


def test_everything_and_a_page_is_the_default():
    assert launch() == Launch(processes=PROCESS_NAMES, router=True, browser=True)


def test_a_network_that_is_named_is_joined():
    assert not launch("--connect", "tls/192.0.2.1:7447").router


@pytest.mark.parametrize("words", [("--headless",), ("--no-browser",), ("--only", "robot,camera")])
def test_there_is_no_browser_where_there_is_no_page_or_nobody_wants_it(words):
    assert not launch(*words).browser


def test_an_empty_model_is_taught_unless_somebody_wants_to_do_that_at_the_page():
    taught, untaught = (_jobs(launch(*words), Path("c.json")) for words in ((), ("--untaught",)))
    assert {job.name for job in taught} - {job.name for job in untaught} == {TEACHER}


def test_only_some_processes_are_started():
    assert launch("--only", "robot, camera").processes == ("robot", "camera")
    with pytest.raises(CommandFailed, match=r"'ghost'.*perception"):
        launch("--only", "robot,ghost")


@pytest.mark.parametrize("nothing", ["", ",", " "])
def test_nothing_is_not_taken_for_everything(nothing):
    with pytest.raises(CommandFailed, match=r"--only.*''.*perception"):
        launch("--only", nothing)


def test_an_unknown_scene_is_named_before_anything_starts():
    with pytest.raises(SimError, match=r"'dishwaser'.*dishwasher"):
        configuration(arguments("--scene", "dishwaser"))


def test_a_report_that_could_not_be_written_is_refused_before_anything_starts(tmp_path):
    assert launch("--json", str(tmp_path / "out.json")).json == tmp_path / "out.json"
    for path in (tmp_path, tmp_path / "missing" / "out.json"):
        with pytest.raises(CommandFailed, match=re.escape(str(path.parent if path is not tmp_path else path))):
            launch("--json", str(path))


def test_headless_puts_a_script_in_the_operators_place():
    by_hand, scripted = configuration(arguments()), configuration(arguments("--headless", "--once"))
    assert isinstance(by_hand.master.device, Page)
    assert isinstance(scripted.master.device, Scripted)
    assert (by_hand.station.scripted, by_hand.station.once) == (False, False)
    assert (scripted.station.scripted, scripted.station.once) == (True, True)


def test_flags_stand_above_the_file(tmp_path):
    path = tmp_path / "retouch.toml"
    path.write_text('name = "left"\nseed = 3\n[robot]\nscene = "table"\nlease_s = 2.0\n')
    asked = configuration(arguments("--config", str(path), "--seed", "4", "--scene", "dishwasher"))
    assert (asked.name, asked.seed, asked.robot.scene, asked.robot.lease_s) == ("left", 4, "dishwasher", 2.0)


@pytest.mark.parametrize(
    ("listen", "own"),
    [
        ("tls/0.0.0.0:7447", "tls/127.0.0.1:7447"),
        ("tls/[::]:7447", "tls/[::1]:7447"),
        ("tls/192.0.2.1:7447", "tls/192.0.2.1:7447"),
    ],
)
def test_this_machines_processes_reach_their_own_router(listen, own):
    assert reachable(listen) == own
    assert configuration(arguments("--listen", listen)).connect == own


@pytest.fixture
def taken():
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield server.getsockname()[1]


def test_a_router_that_could_not_listen_is_refused_before_anything_starts(taken):
    configured = Configuration(listen=f"tcp/127.0.0.1:{taken}")
    with pytest.raises(EndpointInUse, match=f"{taken}.*--listen"):
        check_ports(configured, launch("--only", "robot"))
    check_ports(configured, launch("--only", "robot", "--connect", "tcp/127.0.0.1:7447"))


@pytest.mark.parametrize(
    ("process", "sections", "setting"),
    [
        ("station", lambda port: {"station": StationSection(port=port)}, "[station] port"),
        ("viewer", lambda port: {"viewer": ViewerSection(web_port=port)}, "[viewer] web_port"),
        ("viewer", lambda port: {"viewer": ViewerSection(stream_port=port, web_port=1024)}, "[viewer] stream_port"),
    ],
)
def test_a_page_that_could_not_be_served_is_refused_before_anything_starts(taken, process, sections, setting):
    configured = Configuration(**sections(taken))
    with pytest.raises(PortInUse, match=re.escape(setting)):
        check_ports(configured, launch("--only", process, "--connect", "tcp/127.0.0.1:7447"))
    check_ports(configured, launch("--only", "robot", "--connect", "tcp/127.0.0.1:7447"))
