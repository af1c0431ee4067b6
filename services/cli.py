"""The command line: `retouch`."""

from __future__ import annotations

import argparse
import contextlib
import errno
import logging
import sys
from collections.abc import Sequence

from lfd.exceptions import LfdError, StorageUnavailable
from protocol.exceptions import ProtocolError
from services.commands.parser import Parser
from services.commands.table import COMMANDS
from services.process.exceptions import CannotWrite, EnvironmentFault, ServiceError
from services.process.exit_codes import Exit
from services.process.lifeline import die_with_parent
from services.process.limits import limit_reached
from services.process.lines import one_line
from services.process.logs import Unhurried, own_stderr
from services.process.suggestion import right
from sim.exceptions import CacheUnusable, DescriptionMissing, DrawingLibraryMissing, SimError, UnknownScene

log = logging.getLogger(__name__)

EXAMPLES = """\
examples:
  retouch up                                  everything on this machine, and a page in the browser
  retouch up --operator anna                  the same; what anna does carries her name
  retouch up --headless --once                the same with a scripted operator; says what happened
  retouch up --site --config network.toml     the robot's side of a network, as the file says
  retouch up --desk --config network.toml     the operator's side
  retouch stop                                emergency stop of the robot
  retouch teach --waypoints reach.csv --object 0.85,0.05,0.55
                                              teach a running model a motion that you wrote down
  retouch top                                 what lives on the network, with rates, ages and drops
  retouch doctor tls/ROBOT:7447               what is wrong between this machine and a robot's, and what to do
  retouch reproduce                           the thesis' analyses, made again: one report
  retouch map --teach                         where a model succeeds, before and after one correction: a picture

exit codes: 0 done, 1 crashed or aim not reached, 2 wrong input, 3 machine or network, 130 interrupted
"""

_QUIET = ("httpx", "httpcore", "asyncio", "uvicorn", "websockets", "matplotlib", "OpenGL")
"""Libraries that log what nobody asked for."""

_ERRNOS_OF_THE_MACHINE = frozenset((errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES, errno.EPERM, errno.ENOTDIR))
"""Errors of files that tell of a disk or of rights, and of no fault in the code."""


def parser() -> argparse.ArgumentParser:
    """The parser of all commands; each adds its flags when it is meant."""
    root = Parser(prog="retouch", description="Teleoperation that learns while it is corrected.", epilog=EXAMPLES)
    root.add_argument("--supervised", type=int, metavar="PID", help=argparse.SUPPRESS)
    commands = root.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=Parser)
    for command in COMMANDS:
        commands.add_parser(command.name, help=command.help, fill=lambda p, c=command: c.action().add_arguments(p))
    return root


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command; what a person can mend is one line and an exit code of its own."""
    supervised = False
    try:
        arguments = parser().parse_args(argv)
        if arguments.supervised is not None:
            supervised = True
            die_with_parent(arguments.supervised)
        _log_to_stderr(logging.DEBUG if arguments.debug else logging.INFO)
        return next(c for c in COMMANDS if c.name == arguments.command).action().run(arguments)
    except KeyboardInterrupt:
        return Exit.INTERRUPTED
    except BrokenPipeError:
        raise
    except Exception as error:
        log.debug("traceback", exc_info=True)
        line, code = _ending(error)
        for handler in logging.getLogger().handlers:
            handler.flush()
        with contextlib.suppress(OSError):
            sys.stderr.write(f"retouch: {one_line(line)}\n")
        return Exit.TRY_AGAIN if supervised and _passes(error) else code


def _log_to_stderr(level: int) -> None:
    if logging.getLogger().hasHandlers():
        return
    logging.basicConfig(level=level, format="%(levelname)s %(message)s", handlers=[Unhurried(own_stderr())])
    for noisy in _QUIET:
        logging.getLogger(noisy).setLevel(logging.WARNING)


def _ending(error: Exception) -> tuple[str, Exit]:
    """What a person reads of an error, and the exit code."""
    limit = limit_reached(error)
    if limit is not None:
        return str(limit), Exit.ENVIRONMENT
    match error:
        case (
            EnvironmentFault() | StorageUnavailable() | CacheUnusable() | DescriptionMissing() | DrawingLibraryMissing()
        ):
            return str(error), Exit.ENVIRONMENT
        case UnknownScene(name=name, known=known):
            return f"unknown scene {name!r}; {right(name, known)}", Exit.BAD_INPUT
        case ServiceError() | ProtocolError() | SimError() | LfdError():
            return str(error), Exit.BAD_INPUT
        case OSError(errno=number, filename=file) if number in _ERRNOS_OF_THE_MACHINE:
            return str(CannotWrite(file or "a file", error.strerror or str(error))), Exit.ENVIRONMENT
        case _:
            return f"failed by {type(error).__name__}: {error}; --debug shows where", Exit.CRASHED


def _passes(error: Exception) -> bool:
    return isinstance(error, EnvironmentFault | StorageUnavailable) and error.passes
