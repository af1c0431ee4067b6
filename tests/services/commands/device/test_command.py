"""`retouch device`, with what is heard made up."""

from contextlib import contextmanager

import pytest

from protocol.codec import encode
from protocol.messages import Controller, OperatorInput
from protocol.topics import OPERATOR_INPUT
from services.bus.zenoh import Passing
from services.cli import parser
from services.commands.device import command
from services.commands.device.hearing import GONE_NS, Hearing
from services.process.clock import ManualClock
from services.process.exceptions import CommandFailed, DeviceMissing
from services.process.profile_files import load_profiles

PAD = Controller("gamepad", 0, "Xbox pad", True, (0.0, 0.0, 0.0, -1.0), (1.0, 0.0))
OTHER = Controller("gamepad", 1, "Generic USB", False, (0.0,), ())
POINTER = Controller("pointer", axes=(0.0,) * 6, buttons=(0.0,))


def passing(**said):
    message = OperatorInput(robot="robot1", topic=OPERATOR_INPUT.name, process="station", **said)
    return Passing("key", encode(OPERATOR_INPUT, message), OPERATOR_INPUT.schema)


@pytest.fixture
def retouch(monkeypatch, tmp_path, capsys):
    """A function that runs `retouch device` among made-up devices; what it prints."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    monkeypatch.setattr(command, "LISTEN_S", 0.0)
    monkeypatch.setattr(command, "REST_S", 0.1)
    monkeypatch.setattr(command, "end_within", lambda: None)

    def run(*arguments, devices=(), missing=()):
        class Heard(Hearing):
            page = OperatorInput(controllers=tuple(devices))

        @contextmanager
        def hearing(configuration, clock, stop):
            heard = Heard(clock, configuration.operator)
            heard.missing = list(missing)
            yield heard

        monkeypatch.setattr(command, "hearing", hearing)
        chosen = parser().parse_args(["device", *arguments])
        assert command.run(chosen) == 0
        return " ".join(capsys.readouterr().out.split())

    return run


def test_the_list_names_devices_profiles_and_what_is_missing(retouch):
    said = retouch("list", devices=(PAD, OTHER), missing=["3-D mice are not looked for"])
    assert "keys: of the page, always there" in said
    assert "gamepad: Xbox pad, 4 axes, 2 buttons, at the page" in said
    assert "gamepad: Generic USB, 1 axes, 0 buttons, in no standard order, at the page" in said
    assert "3-D mice are not looked for" in said
    assert said.endswith("retouch/devices: none")


def test_where_the_page_reads_nothing_it_says_what_to_do(retouch):
    assert "press a button of it with the page in front" in retouch("list")


def test_the_test_shows_axes_buttons_and_where_they_lead(retouch):
    said = retouch("test", "--once", devices=(PAD,))
    assert "-1.00" in said
    assert "+1.00" in said


def test_a_measured_device_has_a_profile_which_is_not_written_over_unasked(retouch):
    arguments = ("calibrate", "--seconds", "0.5", "--device", "xbox")
    said = retouch(*arguments, devices=(PAD, OTHER, POINTER))
    assert said.endswith("xbox-pad.toml")
    (own,) = load_profiles()
    assert (own.name, own.profile.device) == ("xbox-pad", "Xbox pad")
    with pytest.raises(CommandFailed, match="is there already"):
        retouch(*arguments, devices=(PAD,))
    retouch(*arguments, "--replace", devices=(PAD,))
    retouch(*arguments, "--name", "mine", devices=(PAD,))
    assert {one.name for one in load_profiles()} == {"xbox-pad", "mine"}


def test_without_a_device_or_with_several_it_says_so_in_one_line(retouch):
    with pytest.raises(DeviceMissing, match="press one of its buttons"):
        retouch("calibrate", devices=(POINTER,))
    with pytest.raises(CommandFailed, match=r"which device\? Xbox pad, Generic USB: give a part"):
        retouch("calibrate", devices=(PAD, OTHER))


@pytest.mark.parametrize("name", ["../evil", "a/b", "..", ""])
def test_a_profiles_name_is_one_of_a_file(name, capsys):
    with pytest.raises(SystemExit) as ended:
        parser().parse_args(["device", "calibrate", "--name", name])
    assert ended.value.code == 2
    assert "--name" in capsys.readouterr().err


@pytest.mark.parametrize(("name", "file"), [("Xbox 360 (v2)", "xbox-360-v2"), ("é", "device"), ("", "device")])
def test_a_device_s_name_becomes_one_of_a_file(name, file):
    assert command.slug(name) == file


def test_the_newest_of_the_operator_s_station_counts_until_it_falls_silent():
    clock = ManualClock()
    heard = Hearing(clock, "anna")
    heard.hear(passing(operator="bert", controllers=(OTHER,)))
    heard.hear(Passing("key", b"\xc1", OPERATOR_INPUT.schema))
    assert heard.controllers() == ()
    heard.hear(passing(operator="anna", controllers=(PAD,)))
    assert heard.controllers() == (("the page", PAD),)
    clock.advance(GONE_NS / 1e9 + 0.01)
    assert heard.controllers() == ()
