"""`retouch device`: which input devices there are, what they say, and how they are measured."""

from __future__ import annotations

import re
import threading
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from pathlib import Path

from rich.live import Live
from rich.table import Table

from protocol.messages import Controller
from services.commands.arguments import add_network, within
from services.commands.device.hearing import Hearing, hearing
from services.commands.device.measuring import measured, profile, remarks
from services.commands.settings import configuration as configured
from services.commands.terminal import Terminal
from services.master.devices.controllers import hand
from services.master.devices.profiles import Profiles
from services.process.clock import SystemClock
from services.process.ending import end_within
from services.process.exceptions import CannotWrite, CommandFailed, DeviceMissing
from services.process.profile_files import SUFFIX, load_profiles, profiles_folder, save_profile
from services.process.runner import stop_on_signals

LISTEN_S = 1.5
LOOK_S = 0.02
DRAW_S = 0.1
REST_S = 2.0
MOVE_S = 10.0

_ABOUT = """\
list       the devices that can be heard: those that a browser reads, while a station
           runs, and those at this computer; and your profiles
test       what each says, live: axes, buttons, and where they would lead the robot
calibrate  measures where the axes of one device rest and how far they go, and writes
           a profile that counts from the next start of `retouch up` or `retouch master`

A browser tells of a gamepad once one of its buttons was pressed, with the page in
front. Nothing here moves a robot; keep no motion running while you calibrate.

  retouch device list
  retouch device test --operator anna
  retouch device calibrate --device xbox --name my-pad
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = _ABOUT
    parser.add_argument("what", choices=("list", "test", "calibrate"))
    add_network(parser)
    parser.add_argument(
        "--device", metavar="TEXT", default="", help="a part of the device's name, where there are several"
    )
    parser.add_argument("--name", metavar="NAME", type=_name, help="of the profile to write (default: the device's)")
    parser.add_argument("--replace", action="store_true", help="write over a profile of that name")
    parser.add_argument("--once", action="store_true", help="test: print what they say now, and end")
    parser.add_argument(
        "--seconds",
        type=within(0.5, 600.0, "seconds"),
        metavar="S",
        default=MOVE_S,
        help=f"calibrate: to move everything in (default: {MOVE_S:g})",
    )


def run(arguments: Namespace) -> int:
    """See `Action`.

    Raises:
        DeviceMissing: there is none to calibrate.
        CommandFailed: which one is meant is not clear, or its profile is there already.
        CannotWrite: the profile cannot be written.
        ConfigurationError: a profile cannot be used.
    """
    configuration = configured(arguments)
    stop = stop_on_signals()
    end_within()
    with hearing(configuration, SystemClock(), stop) as heard:
        stop.wait(LISTEN_S)
        match arguments.what:
            case "list":
                _list(heard)
            case "test":
                _test(heard, stop, once=arguments.once)
            case _:
                _calibrate(heard, stop, arguments)
    return 0


def _list(heard: Hearing) -> None:
    console = Terminal()
    page = heard.page
    if page is not None:
        _say(console, "keys: of the page, always there")
    for where, one in heard.controllers():
        _say(console, f"{one.kind}: {told(one)}, at {where}")
    if page is not None and not page.controllers:
        _say(console, "the page reads no other device: press a button of it with the page in front")
    for line in heard.missing:
        _say(console, line)
    own = load_profiles()
    _say(console, f"profiles in {profiles_folder()}: {', '.join(one.name for one in own) or 'none'}")


def _say(console: Terminal, line: str) -> None:
    """A line as it is: a path that is broken into two cannot be copied."""
    console.print(line, highlight=False, markup=False, soft_wrap=True)


def told(device: Controller) -> str:
    """A device in words."""
    order = "" if device.standard or device.kind != "gamepad" else ", in no standard order"
    return f"{device.name or 'the pad on the page'}, {len(device.axes)} axes, {len(device.buttons)} buttons{order}"


def _test(heard: Hearing, stop: threading.Event, *, once: bool) -> None:
    console = Terminal(width=None if Terminal().is_terminal else 120)
    profiles = Profiles(load_profiles())
    if once:
        console.print(_table(heard, profiles))
        return
    with Live(_table(heard, profiles), console=console) as live:
        while not stop.wait(DRAW_S):
            live.update(_table(heard, profiles))


def _table(heard: Hearing, profiles: Profiles) -> Table:
    """A row a device: what it says, and where that leads."""
    table = Table("device", "axes", "buttons", "leads x y z", "turns", title="retouch device test")
    for _, one in heard.controllers():
        did = hand(one, profiles.of(one))
        pressed = " ".join(str(i) for i, button in enumerate(one.buttons) if button >= 0.5)
        table.add_row(
            f"{one.kind}: {one.name}", _numbers(one.axes), pressed or "none", _numbers(did.push), _numbers(did.turn)
        )
    if not table.rows:
        table.add_row("none is heard", "", "", "", "")
    return table


def _numbers(values: Sequence[float]) -> str:
    return " ".join(f"{value:+.2f}" for value in values)


def _calibrate(heard: Hearing, stop: threading.Event, arguments: Namespace) -> None:
    device = chosen([one for _, one in heard.controllers()], arguments.device)
    path = profiles_folder() / f"{arguments.name or slug(device.name)}{SUFFIX}"
    if path.exists() and not arguments.replace:
        raise CommandFailed(f"{path} is there already: give --name another one, or --replace")
    console = Terminal()
    _say(console, f"{device.name}: let go of it for {REST_S:g} s.")
    resting = _record(heard, stop, device, REST_S)
    _say(console, f"Now move every stick and trigger to all its ends, for {arguments.seconds:g} s.")
    moving = _record(heard, stop, device, arguments.seconds)
    if not resting or not moving:
        raise DeviceMissing(device.name, "it fell silent while it was measured: keep the page in front, and try again")
    axes = measured(resting, moving)
    notes = remarks(axes)
    try:
        save_profile(path, profile(device, axes), ["Measured by `retouch device calibrate`.", *notes])
    except OSError as error:
        raise CannotWrite(path, error.strerror or str(error)) from None
    for line in notes:
        _say(console, line)
    _say(console, f"written: {path}")


def chosen(devices: Sequence[Controller], text: str) -> Controller:
    """The one device that is meant.

    Raises:
        DeviceMissing: there is none.
        CommandFailed: there are several.
    """
    fit = [one for one in devices if one.kind != "pointer" and text.lower() in one.name.lower()]
    if not fit:
        raise DeviceMissing(
            text or "device", "press one of its buttons with the page in front; see `retouch device list`"
        )
    if len(fit) > 1:
        names = ", ".join(one.name for one in fit)
        raise CommandFailed(f"which device? {names}: give a part of its name with --device")
    return fit[0]


def _record(heard: Hearing, stop: threading.Event, device: Controller, seconds: float) -> list[Controller]:
    """What the device says in the time."""
    said = []
    until = time.monotonic() + seconds
    while time.monotonic() < until and not stop.wait(LOOK_S):
        said += [one for _, one in heard.controllers() if (one.kind, one.number) == (device.kind, device.number)]
    return said


def slug(name: str) -> str:
    """A device's name as one of a file."""
    return re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")[:40] or "device"


def _name(text: str) -> str:
    if Path(text).name != text or not text.strip(". "):
        raise ValueError(text)
    return text
