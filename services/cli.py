"""The command line: `retouch`."""

from __future__ import annotations

import argparse
import logging
import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NoReturn

import msgspec

from lfd.exceptions import LfdError
from protocol.exceptions import ProtocolError
from protocol.messages import Vector3
from protocol.table import query_table, topic_table
from protocol.topics import checked_name
from services.commands.up.child import EXIT_BAD_INPUT
from services.process.config import Configuration, RobotSection, Scripted, load
from services.process.exceptions import CommandFailed, RoomMissing, ServiceError
from services.process.processes import PROCESS_NAMES, PROCESSES, process
from sim.exceptions import SimError

log = logging.getLogger(__name__)

EXIT_FAILED = 1
EXIT_INTERRUPTED = 130

TAUGHT_S = 10.0
"""Duration of a motion through waypoints, unless told otherwise: the thesis' time of an autonomous execution."""

WIDEST_M = 0.5
"""Beyond it no scene has a start that the arm can take."""

LONGEST_S = 3600.0
"""Duration of the longest motion that a message carries."""

EXAMPLES = """\
examples:
  retouch up                                  everything on this machine, and a page in the browser
  retouch up --headless --once                the same with a scripted operator; says what happened
  retouch up --listen tcp/0.0.0.0:7447 --only robot,camera,perception,model
                                              the robot's side, for operators on other machines
  retouch up --connect tcp/ROBOT:7447 --only master,viewer,station
                                              the operator's side
  retouch teach --waypoints reach.csv --object 0.85,0.05,0.55
                                              teach a running model a motion that you wrote down
  retouch top                                 what lives on the network, with rates, ages and drops
  retouch reproduce                           the thesis' analyses, made again: one report
  retouch map --teach                         where a model succeeds, before and after one correction: a picture
"""

MAP_ABOUT = """\
Executes a model's predictions under some hundred conditions (an object's position
and a start pose each), simulated on all cores, and draws which succeeded, before
the newest corrections and after them. A condition is unreachable, and does not
count, where no motion can start, or where every prediction fails and the scene's
own safe way does too: the map judges the model, not the scene.
"""

MAP_EXAMPLES = """\
examples:
  retouch map --teach                         the dishwasher, before and after one correction
  retouch map --teach --kind promp            the same with the thesis' own model
  retouch map --database model.sqlite --before 3 --samples 400
                                              a model of yours, without its last 3 updates and with them
"""


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line instead of printing the usage.

    Attributes:
        about_later: makes the last line of the help, when it is asked for.
    """

    about_later: Callable[[], str] | None = None

    def format_help(self) -> str:
        """As of any parser, with the last line."""
        if self.about_later is not None:
            self.epilog = self.about_later()
        return super().format_help()

    def error(self, message: str) -> NoReturn:
        self.exit(EXIT_BAD_INPUT, f"{self.prog}: {message}; see '{self.prog} --help'\n")


def _common() -> _Parser:
    common = _Parser(add_help=False)
    common.add_argument("--config", type=Path, metavar="FILE", help="a TOML file; see README for its keys")
    common.add_argument("--robot", metavar="NAME", help="the robot's name on the network (default: robot1)")
    common.add_argument("--connect", metavar="ENDPOINT", help="of a router, such as tcp/192.0.2.1:7447")
    common.add_argument("--debug", action="store_true", help="log more, and tracebacks")
    return common


def parser() -> argparse.ArgumentParser:
    """The parser of all commands."""
    root = _Parser(
        prog="retouch",
        description="Teleoperation that learns while it is corrected.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    root.add_argument("--supervised", type=int, metavar="PID", help=argparse.SUPPRESS)
    commands = root.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=_Parser)
    common = _common()
    _add_up(commands, common)
    for one in PROCESSES:
        _add_scene(commands.add_parser(one.name, parents=[common], help=f"the process that has to {one.about}"))
    router = commands.add_parser("router", parents=[common], help="where the processes of a site meet")
    router.add_argument("--listen", metavar="ENDPOINT", help="default: tcp/127.0.0.1:7447")
    _add_teach(commands, common)
    prepare = commands.add_parser("prepare", help="make and keep what every simulated run needs (once)")
    prepare.add_argument("--debug", action="store_true", help=argparse.SUPPRESS)
    echo = commands.add_parser("echo", parents=[common], help="print what passes on a key expression")
    echo.add_argument("key", metavar="KEY", help="such as 'retouch/@v1/robot1/state/**'")
    echo.add_argument("--count", type=int, metavar="N", help="end after N messages")
    top = commands.add_parser("top", parents=[common], help="the live processes of a network")
    top.add_argument("--once", action="store_true", help="print one table and end")
    stop = commands.add_parser("stop", parents=[common], help="emergency stop of a robot")
    stop.add_argument("--release", action="store_true", help="release the stop instead")
    replay = commands.add_parser("replay", help="open a recording in Rerun")
    replay.add_argument("file", type=Path, metavar="FILE")
    replay.add_argument("--debug", action="store_true", help=argparse.SUPPRESS)
    commands.add_parser("topics", help="print the table of topics and queries")
    _add_reproduce(commands)
    _add_map(commands)
    return root


def _seed(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"must be a whole number, at least 0, not {text!r}")
    return int(text)


def _at_least_one(text: str) -> int:
    if not text.isdecimal() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"must be a whole number, at least 1, not {text!r}")
    return int(text)


def _add_scene(command: _Parser) -> None:
    command.about_later = _about_scenes
    command.add_argument("--scene", metavar="S", help=f"the simulated scene (default: {RobotSection().scene})")
    command.add_argument("--variant", metavar="V", help="its arrangement that is taught (default: the last one)")
    command.add_argument("--seed", type=_seed, metavar="N", help="of the target's place and the scripted hand")


def _about_scenes() -> str:
    # Imported here: only who asks for help waits until the scenes are loaded.
    from sim.tasks import SCENES  # noqa: PLC0415

    return "scenes: " + "; ".join(f"{name} ({', '.join(scene.variants)})" for name, scene in SCENES.items())


def _add_up(commands: argparse._SubParsersAction[_Parser], common: _Parser) -> None:
    up = commands.add_parser("up", parents=[common], help="start everything and watch over it")
    _add_scene(up)
    up.add_argument("--headless", action="store_true", help="a scripted operator instead of the page")
    up.add_argument("--once", action="store_true", help="end when the loop has closed (headless), or the run is ended")
    up.add_argument("--fresh", action="store_true", help="start from an empty model, kept in the run's folder")
    up.add_argument("--json", type=Path, metavar="FILE", help="write what happened")
    up.add_argument("--listen", metavar="ENDPOINT", help="where other machines may join (default: this machine only)")
    up.add_argument("--only", metavar="A,B", help=f"start only some of: {', '.join(PROCESS_NAMES)}")
    up.add_argument("--no-browser", action="store_true", help="do not open the page")


def _add_reproduce(commands: argparse._SubParsersAction[_Parser]) -> None:
    reproduce = commands.add_parser(
        "reproduce",
        help="make the thesis' analyses again, and one report of them",
        description="Makes the thesis' analyses again, with its method and with the default model, and writes one"
        " HTML report. What is done already is kept, and done again only where the code or the seed has changed.",
    )
    reproduce.add_argument("names", nargs="*", metavar="NAME", help="of analyses (default: all)")
    reproduce.add_argument("--list", action="store_true", help="name the analyses and end")
    reproduce.add_argument(
        "--out", type=Path, metavar="FOLDER", default=Path("reproduction"), help="default: ./reproduction"
    )
    reproduce.add_argument("--fresh", action="store_true", help="do again what is done already")
    reproduce.add_argument("--jobs", type=_at_least_one, metavar="N", default=1, help="analyses at once (default: 1)")
    reproduce.add_argument("--seed", type=_seed, metavar="N", default=0, help="of all that is random (default: 0)")
    reproduce.add_argument("--debug", action="store_true", help=argparse.SUPPRESS)


def _add_map(commands: argparse._SubParsersAction[_Parser]) -> None:
    command = commands.add_parser(
        "map",
        help="where a model succeeds, before and after a correction: a picture",
        description=MAP_ABOUT,
        epilog=MAP_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    model = command.add_argument_group("the model")
    model.add_argument("--kind", choices=("adaptive", "promp"), default="adaptive", help="promp: the thesis' own")
    model.add_argument(
        "--database", type=Path, metavar="FILE", help="that a model was taught into (default: first demonstrations)"
    )
    model.add_argument(
        "--before", type=_at_least_one, metavar="N", help="newest updates that the earlier stage lacks (default: 1)"
    )
    model.add_argument("--teach", action="store_true", help="let the scripted operator correct it once first")
    where = command.add_argument_group("the conditions")
    where.add_argument("--scene", metavar="S", help="dishwasher or table (default: the database's, or dishwasher)")
    where.add_argument("--variant", metavar="V", help="of the scene (default: the one that was changed)")
    many = where.add_mutually_exclusive_group()
    many.add_argument(
        "--grid", type=_at_least_one, metavar="N", default=16, help="about N times N, evenly (default: 16)"
    )
    many.add_argument("--samples", type=_at_least_one, metavar="N", help="N at random instead")
    where.add_argument(
        "--spread", type=_spread, metavar="M", default=0.05, help="of starts along each axis [m] (default: 0.05)"
    )
    where.add_argument("--seed", type=_seed, metavar="N", default=0, help="of all that is random (default: 0)")
    command.add_argument("--out", type=Path, metavar="FILE.png", default=Path("map.png"), help="default: ./map.png")
    command.add_argument("--json", type=Path, metavar="FILE", help="write what became of each condition")
    command.add_argument("--jobs", type=_at_least_one, metavar="N", help="processes (default: one a core)")
    command.add_argument("--debug", action="store_true", help=argparse.SUPPRESS)


def _add_teach(commands: argparse._SubParsersAction[_Parser], common: _Parser) -> None:
    about = "teach an empty model its first demonstrations, or a model a motion through waypoints"
    teach = commands.add_parser("teach", parents=[common], help=about, description=about)
    _add_scene(teach)
    teach.add_argument(
        "--waypoints",
        type=Path,
        metavar="FILE",
        help="CSV with the columns x,y,z,qw,qx,qy,qz: poses of the gripper in the base frame [m], at least three rows",
    )
    teach.add_argument(
        "--object",
        type=_position,
        metavar="X,Y,Z",
        help="where the waypoints lead to, base frame [m]; write --object=-X,Y,Z where the first is negative",
    )
    teach.add_argument("--undo", action="store_true", help="take back what the model learnt last, and teach nothing")
    teach.add_argument("--duration", type=_seconds, metavar="S", help=f"of the motion [s] (default: {TAUGHT_S:g})")


def _position(text: str) -> Vector3:
    try:
        x, y, z = (_finite(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be X,Y,Z in metres, such as 0.85,0.05,0.55, not {text!r}") from None
    return (x, y, z)


def _seconds(text: str) -> float:
    try:
        seconds = _finite(text)
    except ValueError:
        seconds = 0.0
    if not 0.0 < seconds <= LONGEST_S:
        raise argparse.ArgumentTypeError(f"must be seconds, above 0 and at most {LONGEST_S:g}, not {text!r}")
    return seconds


def _spread(text: str) -> float:
    try:
        spread = _finite(text)
    except ValueError:
        spread = -1.0
    if not 0.0 <= spread <= WIDEST_M:
        raise argparse.ArgumentTypeError(f"must be metres, from 0 to {WIDEST_M:g}, not {text!r}")
    return spread


def _finite(text: str) -> float:
    number = float(text)
    if not math.isfinite(number):
        raise ValueError(text)
    return number


def configuration(arguments: argparse.Namespace) -> Configuration:
    """The configuration file, where one was given, with the flags on top.

    Raises:
        ConfigurationError: the file cannot be used.
        ProtocolError: the robot's name cannot stand in a key.
        SimError: the scene has no such variant.
    """
    result = load(arguments.config) if arguments.config else Configuration()
    changes: dict[str, object] = {
        key: getattr(arguments, flag)
        for key, flag in (("name", "robot"), ("connect", "connect"), ("listen", "listen"), ("seed", "seed"))
        if getattr(arguments, flag, None) is not None
    }
    if getattr(arguments, "listen", None) and not arguments.connect:
        changes["connect"] = reachable(arguments.listen)
    if getattr(arguments, "scene", None):
        changes["robot"] = msgspec.structs.replace(result.robot, scene=arguments.scene)
    if getattr(arguments, "headless", False):
        changes["master"] = msgspec.structs.replace(result.master, device=Scripted())
    station = result.station
    if arguments.command == "up":
        station = msgspec.structs.replace(station, scripted=arguments.headless, once=arguments.once)
    if getattr(arguments, "variant", None):
        station = msgspec.structs.replace(station, variant=arguments.variant)
    result = msgspec.structs.replace(result, station=station, **changes)
    if result.station.variant:
        from sim.tasks import scene  # noqa: PLC0415

        scene(result.robot.scene).check(result.station.variant)
    checked_name(result.name)
    return result


def reachable(listen: str) -> str:
    """The endpoint by which this machine reaches its own router that listens on all addresses."""
    return listen.replace("/0.0.0.0:", "/127.0.0.1:").replace("/[::]:", "/[::1]:")


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command; errors that a person can mend are one line and exit code 2."""
    arguments = parser().parse_args(argv)
    debug = getattr(arguments, "debug", False)
    logging.basicConfig(
        level=logging.DEBUG if debug else logging.INFO, format="%(levelname)s %(message)s", stream=sys.stderr
    )
    for noisy in ("httpx", "httpcore", "asyncio", "uvicorn", "websockets", "matplotlib", "OpenGL"):
        logging.getLogger(noisy).setLevel(logging.WARNING)
    try:
        return _dispatch(arguments)
    except (ServiceError, ProtocolError, SimError, LfdError) as error:
        log.debug("traceback", exc_info=True)
        sys.stderr.write(f"retouch: {error}\n")
        return EXIT_BAD_INPUT
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED
    except Exception as error:
        log.debug("traceback", exc_info=True)
        sys.stderr.write(f"retouch: failed by {type(error).__name__}: {error}; --debug shows where\n")
        return EXIT_FAILED


def _dispatch(arguments: argparse.Namespace) -> int:
    # Each command imports what it needs: a robot's computer has no page, a station no physics.
    alone = _WITHOUT_NETWORK.get(arguments.command)
    if alone is not None:
        return alone(arguments)
    settings = configuration(arguments)
    if arguments.supervised is not None:
        from services.process.worker import die_with_parent  # noqa: PLC0415

        die_with_parent(arguments.supervised)
    match arguments.command:
        case "up":
            from services.commands.up.launch import Launch, launch  # noqa: PLC0415

            return launch(settings, Launch.from_arguments(arguments))
        case "router":
            from services.commands.router import run_router  # noqa: PLC0415

            run_router(settings, arguments.connect)
        case "teach":
            _teach(settings, arguments)
        case "echo":
            from services.commands.echo import echo  # noqa: PLC0415

            echo(settings.connect, arguments.key, arguments.count)
        case "top":
            from services.commands.top import top  # noqa: PLC0415

            top(settings.connect, once=arguments.once)
        case "stop":
            from services.commands.stop import release, stop  # noqa: PLC0415

            (release if arguments.release else stop)(settings)
        case name:
            from services.process.worker import run_process  # noqa: PLC0415

            run_process(process(name), settings)
    return 0


def _topics(_: argparse.Namespace) -> int:
    sys.stdout.write(f"{topic_table()}\n\n{query_table()}\n")
    return 0


def _replay(arguments: argparse.Namespace) -> int:
    from services.viewer.replay import replay  # noqa: PLC0415

    replay(arguments.file)
    return 0


def _prepare(_: argparse.Namespace) -> int:
    from services.commands.teach import prepare_all  # noqa: PLC0415

    prepare_all()
    return 0


def _reproduce(arguments: argparse.Namespace) -> int:
    try:
        from services.commands.reproduce import Request, reproduce, show_list  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise RoomMissing("study", error.name or "?") from None
    if arguments.list:
        show_list()
        return 0
    return reproduce(Request.from_arguments(arguments))


def _map(arguments: argparse.Namespace) -> int:
    try:
        from services.commands.map import Request, draw_map  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise RoomMissing("study", error.name or "?") from None
    draw_map(Request.from_arguments(arguments))
    return 0


_WITHOUT_NETWORK: dict[str, Callable[[argparse.Namespace], int]] = {
    "topics": _topics,
    "replay": _replay,
    "prepare": _prepare,
    "reproduce": _reproduce,
    "map": _map,
}


def _teach(settings: Configuration, arguments: argparse.Namespace) -> None:
    from services.commands.teach import take_back, teach, teach_waypoints  # noqa: PLC0415

    given = [flag for flag in ("waypoints", "object", "duration") if getattr(arguments, flag) is not None]
    if arguments.undo:
        if given:
            raise CommandFailed(f"--undo teaches nothing: leave out --{given[0]}, or --undo")
        take_back(settings)
    elif not given:
        teach(settings)
    elif not {"waypoints", "object"} <= set(given):
        raise CommandFailed(f"--{given[0]} alone teaches nothing: give --waypoints FILE and --object X,Y,Z")
    else:
        teach_waypoints(settings, arguments.waypoints, arguments.object, arguments.duration or TAUGHT_S)
