"""Flags that several commands share, and the types of their values."""

from __future__ import annotations

import math
from argparse import SUPPRESS, ArgumentParser, ArgumentTypeError
from collections.abc import Callable
from pathlib import Path

from protocol.messages import Vector3
from services.commands.parser import Parser
from services.process.config import RobotSection


def add_debug(parser: ArgumentParser) -> None:
    """What every command understands and few need."""
    parser.add_argument("--debug", action="store_true", help=SUPPRESS)


def add_network(parser: ArgumentParser) -> None:
    """Which robot, on which network, for whom."""
    parser.add_argument("--config", type=Path, metavar="FILE", help="a TOML file; see README for its keys")
    parser.add_argument("--robot", metavar="NAME", help="the robot's name on the network (default: robot1)")
    parser.add_argument("--operator", metavar="NAME", help="who is at this station (default: operator)")
    parser.add_argument("--connect", metavar="ENDPOINT", help="of a router, such as tls/192.0.2.1:7447")
    parser.add_argument(
        "--tls", metavar="FOLDER", help="this machine's certificates (default: ~/.config/retouch/certs)"
    )
    parser.add_argument("--insecure", action="store_true", help="let endpoints without certificates be open to others")
    parser.add_argument("--debug", action="store_true", help="log more, and tracebacks")


def add_scene(parser: ArgumentParser) -> None:
    """Which simulated world; the help names them all."""
    if isinstance(parser, Parser):
        parser.about_later = _about_scenes
    parser.add_argument(
        "--task", "--scene", metavar="NAME|FILE", help=f"the task, or the scene of it (default: {RobotSection().scene})"
    )
    parser.add_argument(
        "--robot-model", metavar="NAME|FILE", help="the robot in it; see 'retouch robot list' (default: tiago)"
    )
    parser.add_argument("--variant", metavar="V", help="its arrangement that is taught (default: the last one)")
    parser.add_argument("--seed", type=whole(0), metavar="N", help="of the target's place and the scripted hand")


def add_skill(parser: ArgumentParser) -> None:
    """Which of a robot's skills is in use to begin with."""
    parser.add_argument("--skill", metavar="NAME", help="the skill in use to begin with; see 'retouch skill --help'")


def add_backend(parser: ArgumentParser) -> None:
    """What moves the robot."""
    parser.add_argument(
        "--backend", metavar="KIND", help="what moves the robot: simulated (the default), or franka, say; see README"
    )
    parser.add_argument("--host", dest="backend_host", metavar="H", help="name or address at which the arm is reached")


def _about_scenes() -> str:
    # Imported here: only who asks for help waits until the scenes are loaded.
    from sim.tasks import SCENES  # noqa: PLC0415

    return "scenes: " + "; ".join(f"{name} ({', '.join(scene.variants)})" for name, scene in SCENES.items())


def whole(least: int) -> Callable[[str], int]:
    """The type of a whole number that is not smaller than `least`, which is not negative."""

    def read(text: str) -> int:
        if not (text.isascii() and text.isdecimal() and int(text) >= least):
            raise ArgumentTypeError(f"must be a whole number, at least {least}, not {text!r}")
        return int(text)

    return read


def within(low: float, high: float, what: str, *, above: bool = False) -> Callable[[str], float]:
    """The type of a number from `low` to `high`, both of them included, or only `high` where it has to be above.

    Args:
        low: the smallest one.
        high: the largest one.
        what: the number is, such as "metres".
        above: whether `low` itself is too small.
    """
    bounds = f"above {low:g} and at most {high:g}" if above else f"from {low:g} to {high:g}"

    def read(text: str) -> float:
        try:
            number = finite(text)
        except ValueError:
            number = math.nan
        if not low <= number <= high or (above and number == low):
            raise ArgumentTypeError(f"must be {what}, {bounds}, not {text!r}")
        return number

    return read


def position(text: str) -> Vector3:
    """X,Y,Z [m]."""
    try:
        x, y, z = (finite(part) for part in text.split(","))
    except ValueError:
        raise ArgumentTypeError(f"must be X,Y,Z in metres, such as 0.85,0.05,0.55, not {text!r}") from None
    return (x, y, z)


def place(text: str) -> tuple[float, ...]:
    """A target's place in a scene: X,Y,Z of an object [m], or as many numbers as it has."""
    try:
        return tuple(finite(part) for part in text.split(","))
    except ValueError:
        raise ArgumentTypeError(f"must be numbers in metres, such as 0.86,0.20,0.553, not {text!r}") from None


def finite(text: str) -> float:
    """The number.

    Raises:
        ValueError: it is none, or no finite one.
    """
    number = float(text)
    if not math.isfinite(number):
        raise ValueError(text)
    return number
