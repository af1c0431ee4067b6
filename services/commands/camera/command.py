"""`retouch camera`: one process alone; with a word after it, what there is to know of cameras."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path

from services.camera.calibration.board import Board
from services.camera.calibration.solving import calibration
from services.camera.calibration.views import read_views
from services.commands import process
from services.commands.arguments import whole, within
from services.commands.camera.collecting import collect
from services.commands.camera.drawing import drawn
from services.commands.camera.eyes import Eye, eyes
from services.commands.settings import configuration
from services.process.calibration import Calibration, calibration_path, load_calibration, save_calibration
from services.process.config import Configuration
from services.process.exceptions import CommandFailed
from services.process.exit_codes import Exit
from services.process.files import write_file

PICTURES = 15

_ABOUT = """\
Without a word: the process that publishes what the cameras see. With one:

list            the cameras, where they are fixed, and what was measured of them
board           the picture of a board, to be printed at 100 % and glued to something flat
calibrate NAME  how a camera sees and where it is fixed, from pictures of the board. While
                the robot runs: lead it by hand to ever other poses and let it stand a
                moment in each. A camera that the hand carries sees a board that lies
                still; one that stands beside, a board that the hand holds. Nothing here
                moves a robot
draw            a picture of the robot with its cameras where they are said to be

  retouch camera board --out board.png
  retouch camera calibrate wrist --keep pictures
  retouch camera calibrate wrist --from pictures --replace
"""

_WORDS = ("list", "board", "calibrate", "draw")


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = _ABOUT
    parser.add_argument("what", nargs="?", choices=_WORDS)
    parser.add_argument("which", nargs="?", metavar="NAME", help="of a camera")
    process.add_arguments(parser)
    parser.add_argument("--out", type=Path, metavar="FILE", help="of a picture (default: board.png, cameras.png)")
    usual = Board()
    parser.add_argument("--columns", type=whole(3), default=usual.columns, help="of the board (default: %(default)s)")
    parser.add_argument("--rows", type=whole(3), default=usual.rows, help="of the board (default: %(default)s)")
    parser.add_argument(
        "--square",
        type=within(0.005, 0.5, "metres"),
        default=usual.square,
        metavar="M",
        help="edge of a square, as it was measured on the print (default: %(default)g)",
    )
    parser.add_argument("--pictures", type=whole(8), default=PICTURES, help="to calibrate by (default: %(default)s)")
    parser.add_argument("--from", type=Path, metavar="FOLDER", dest="folder", help="with pictures that are there")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="for the pictures that are taken")
    parser.add_argument("--replace", action="store_true", help="write over what was measured before")


def run(arguments: Namespace) -> int:
    """See `Action`.

    Raises:
        CommandFailed: there is no such camera, or it is calibrated already.
        CalibrationImpossible: the pictures are not enough; says what to add.
        ConfigurationError: a file cannot be used.
        SimError: the robot cannot be drawn.
        CannotWrite: a picture cannot be written.
    """
    match arguments.what:
        case None:
            return process.run(arguments)
        case "list":
            return _list(configuration(arguments))
        case "board":
            return _board(_meant(arguments), arguments.out or Path("board.png"))
        case "calibrate":
            return _calibrate(configuration(arguments), arguments)
        case _:
            chosen, path = configuration(arguments), arguments.out or Path("cameras.png")
            write_file(path, drawn(chosen))
            return _say(f"written: {path}; of each camera x red, y green, z, which it looks along, blue")


def _meant(arguments: Namespace) -> Board:
    return Board(arguments.columns, arguments.rows, arguments.square)


def _list(chosen: Configuration) -> int:
    for name, eye in eyes(chosen).items():
        found = load_calibration(chosen.name, name)
        _say(f"{name}: {eye}; {'nothing was measured of it' if found is None else measured(found)}")
    return Exit.DONE


def measured(found: Calibration) -> str:
    """What a file says, for people."""
    text = f"focal length {found.focal[0]:.1f} px, {found.error:.2f} px left over in {found.pictures} pictures"
    fixed = found.fixed
    if fixed is None:
        return f"{text}; where it is fixed was not measured"
    at = ", ".join(f"{1e3 * value:.1f}" for value in fixed.position)
    where = f"({at}) mm from {fixed.link or 'the base'}"
    return f"{text}; {where}, the board within {1e3 * fixed.spread:.1f} mm in {fixed.poses} poses"


def _board(board: Board, path: Path) -> int:
    write_file(path, board.png())
    width, height = (1e3 * edge for edge in board.size)
    return _say(
        f"written: {path}, {width:.0f} by {height:.0f} mm with its rim. Print it at 100 %, glue it to something flat "
        f"and measure a square: {1e3 * board.square:.1f} mm, else say --square"
    )


def _calibrate(chosen: Configuration, arguments: Namespace) -> int:
    eye = _eye(chosen, arguments.which)
    path = calibration_path(chosen.name, eye.name)
    if path.exists() and arguments.folder is None:  # its pictures come straightened by it
        raise CommandFailed(
            f"camera {eye.name} is calibrated: take {path} away, start the camera process anew, and calibrate again"
        )
    if path.exists() and not arguments.replace:
        raise CommandFailed(f"camera {eye.name} is calibrated in {path}: --replace writes over it")
    board = _meant(arguments)
    folder = arguments.folder or _taken(chosen, eye, board, arguments)
    found = calibration(read_views(folder), board, eye.link)
    save_calibration(path, found)
    _say(f"{eye.name}: {measured(found)}")
    return _say(f"written: {path}; it counts from the next start of the camera process on")


def _taken(chosen: Configuration, eye: Eye, board: Board, arguments: Namespace) -> Path:
    return collect(chosen, eye, board, count=arguments.pictures, keep=arguments.keep, tell=_say)


def _eye(chosen: Configuration, name: str | None) -> Eye:
    known = eyes(chosen)
    if name not in known:
        what = "which camera is meant is not said" if name is None else f"there is no camera {name}"
        raise CommandFailed(f"{what}: name one of {', '.join(known)}")
    return known[name]


def _say(line: str) -> int:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()
    return Exit.DONE
