"""Both sides of a network from one file: what each starts, where it listens, whom it joins."""

import shutil
import subprocess
from pathlib import Path

import pytest

from services.cli import parser
from services.commands.settings import configuration
from services.commands.up.launch import Launch, _jobs
from services.process.exceptions import UnusableSetting

DEPLOY = Path(__file__).parents[3] / "deploy"


def started(folder, flags, text):
    """The configuration and the launch that a file makes."""
    file = folder / "network.toml"
    file.write_text(text)
    arguments = parser().parse_args(["up", *flags, "--config", str(file)])
    settings = configuration(arguments)
    return settings, Launch.from_arguments(arguments, settings)


def example(name):
    return (DEPLOY / "examples" / f"{name}.toml").read_text()


def router(launch):
    """The words that its router is started with, after the configuration; none where there is no router."""
    return [job.arguments[3:] for job in _jobs(launch, Path("c.json")) if job.name == "router"]


def test_a_site_has_the_robot_s_processes_and_a_router_that_others_reach(tmp_path):
    settings, launch = started(tmp_path, ["--site"], example("network"))
    assert launch.processes == ("robot", "camera", "perception", "model")
    assert (settings.listen, settings.connect) == ("tls/0.0.0.0:7447", "tls/127.0.0.1:7447")
    assert router(launch) == [()]
    assert not launch.page


def test_a_desk_has_the_operator_s_and_a_router_of_its_own_that_joins_the_site(tmp_path):
    text = example("network").replace("router = false", "router = true")
    settings, launch = started(tmp_path, ["--desk"], text)
    assert launch.processes == ("master", "viewer", "station")
    assert (settings.listen, settings.connect) == ("tcp/127.0.0.1:7447", "tcp/127.0.0.1:7447")
    assert router(launch) == [("--connect", "tls/192.0.2.1:7447")]
    assert launch.page


def test_a_desk_without_one_connects_to_the_site(tmp_path):
    settings, launch = started(tmp_path, ["--desk"], example("network"))
    assert settings.connect == "tls/192.0.2.1:7447"
    assert router(launch) == []


def test_a_second_robot_joins_the_first_one_s_router(tmp_path):
    settings, launch = started(tmp_path, ["--site"], example("second-robot"))
    assert (settings.name, settings.connect) == ("garage", "tls/192.0.2.1:7447")
    assert router(launch) == []


def test_where_neither_reaches_the_other_both_dial_a_third(tmp_path):
    site, robot = started(tmp_path, ["--site"], example("rendezvous"))
    _, desk = started(tmp_path, ["--desk"], example("rendezvous"))
    assert router(robot) == router(desk) == [("--connect", "tls/meeting.example.org:7447")]
    assert site.connect == "tcp/127.0.0.1:7447"


def test_only_some_of_a_side_can_be_started(tmp_path):
    _, launch = started(tmp_path, ["--site", "--only", "robot"], example("network"))
    assert launch.processes == ("robot",)


@pytest.mark.parametrize(
    ("flag", "text", "setting"),
    [("--desk", "", "[desk] connect"), ("--site", '[site]\nlisten = ""\n', "[site]")],
)
def test_a_file_that_does_not_say_where_the_others_are_is_one_line(tmp_path, flag, text, setting):
    with pytest.raises(UnusableSetting) as caught:
        started(tmp_path, [flag], text)
    assert str(caught.value).startswith(f"{setting}: ")
    assert "tls/" in str(caught.value), "what would be right"


def test_a_machine_is_one_side(capsys):
    with pytest.raises(SystemExit):
        parser().parse_args(["up", "--site", "--desk"])
    assert "not allowed with" in capsys.readouterr().err


@pytest.mark.skipif(shutil.which("systemd-analyze") is None, reason="systemd judges its units")
@pytest.mark.parametrize("side", ["site", "desk"])
def test_systemd_understands_the_unit_and_finds_it_closed(tmp_path, side):
    name = f"retouch-{side}.service"
    unit = tmp_path / name
    unit.write_text((DEPLOY / "systemd" / name).read_text().replace("/opt/retouch", str(DEPLOY.parent)))
    judged = subprocess.run(["systemd-analyze", "verify", unit], capture_output=True, text=True, check=False)
    assert (judged.returncode, judged.stderr) == (0, "")
    security = ["systemd-analyze", "security", "--offline=true", "--threshold=20", unit]
    assert subprocess.run(security, capture_output=True, check=False).returncode == 0, "its exposure is above 2 of 10"
