"""`retouch up`: what to start, with which configuration, in which folder."""

from __future__ import annotations

import contextlib
import logging
import os
import sys
import time
from argparse import Namespace
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Self

import msgspec

from services.accounts.policy import asks
from services.certificates.page import secured
from services.commands.sides import placed
from services.commands.terminal import Terminal
from services.commands.up.child import Child, Job
from services.commands.up.network import Page
from services.commands.up.supervisor import ROUTER, Supervisor
from services.commands.up.voice import Spoken, Voice
from services.process.config import FOLDER_SETTING, Configuration, save
from services.process.endpoint import OVER_TCP, parse
from services.process.exceptions import CommandFailed, EndpointInUse, FolderUnusable, PortInUse
from services.process.exit_codes import Exit
from services.process.ports import check_port
from services.process.processes import PROCESS_NAMES
from services.process.runner import stop_on_signals
from services.process.suggestion import right

TEACHER = "teach"

FREED_S = 1.0
"""A run that has just ended frees its ports within this time."""

POLL_S = 0.1


@dataclass(frozen=True)
class Launch:
    """How to run.

    Attributes:
        processes: which to start.
        router: whether to start a router, rather than join one.
        upstream: endpoint of another router that it joins; empty for none.
        headless: a scripted operator teaches.
        once: end when the loop has closed.
        fresh: start from an empty model, kept in the run's folder.
        untaught: an empty model is left so, for whoever shows it the first motion.
        json: where to write the report.
        page: an operator's page belongs to it.
        browser: open the page.
    """

    processes: tuple[str, ...] = PROCESS_NAMES
    router: bool = True
    upstream: str = ""
    headless: bool = False
    once: bool = False
    fresh: bool = False
    untaught: bool = False
    json: Path | None = None
    page: bool = True
    browser: bool = True

    @classmethod
    def from_arguments(cls, arguments: Namespace, configuration: Configuration) -> Self:
        """From the command line, and what the configuration says of the side of the network that is started.

        Raises:
            CommandFailed: --only names a process that does not exist, or the report cannot be written.
        """
        named = arguments.only is not None
        side = arguments.side
        every = PROCESS_NAMES if side is None else side.processes
        names = tuple(name.strip() for name in arguments.only.split(",")) if named else every
        for name in names:
            if name not in PROCESS_NAMES:
                raise CommandFailed(f"--only: unknown process {name!r}; {right(name, PROCESS_NAMES)}")
        if arguments.json is not None:
            check_report(arguments.json)
        page = not arguments.headless and "station" in names
        at = placed(configuration, side) if side is not None else None
        return cls(
            processes=names,
            router=arguments.connect is None and (at is None or at.router),
            upstream=at.upstream if at is not None else "",
            headless=arguments.headless,
            once=arguments.once,
            fresh=arguments.fresh,
            untaught=arguments.untaught,
            json=arguments.json,
            page=page,
            browser=page and not arguments.no_browser,
        )


def check_report(path: Path) -> None:
    """Let pass where a report can be written.

    Raises:
        CommandFailed: it cannot.
    """
    if not path.parent.is_dir():
        raise CommandFailed(f"--json: the folder {path.parent} does not exist")
    if path.is_dir():
        raise CommandFailed(f"--json: {path} is a folder; name a file in it")
    if path.exists() and not path.is_file():
        raise CommandFailed(f"--json: {path} is a device or pipe; name a file")


def launch(configuration: Configuration, options: Launch) -> int:
    """Run until interrupted, or until a scripted run has ended; 0 where it did what it was started for.

    Raises:
        ServiceError: it cannot start.
    """
    started = time.monotonic()
    stop = stop_on_signals()
    page = _page(configuration, options)
    _await_ports(configuration, options)
    folder = _run_folder(Path(configuration.viewer.folder))
    configuration = _for_run(configuration, folder, options)
    resolved = folder / "configuration.json"
    # A stream of its own: a terminal that takes no more keeps nobody else from writing.
    console = Terminal(file=os.fdopen(os.dup(sys.stdout.fileno()), "w", 1, sys.stdout.encoding, "replace"))
    try:
        save(configuration, resolved)
        voice = Voice(console, folder / "log.txt", live=console.is_terminal and not options.headless)
    except OSError as error:
        raise FolderUnusable(folder, FOLDER_SETTING, error.strerror or str(error)) from None
    logging.getLogger().handlers[:] = [Spoken(voice)]
    voice.say("retouch", f"the run's folder is {folder}")
    children = [Child(job, voice.say) for job in _jobs(options, resolved)]
    supervisor = Supervisor(
        configuration,
        children,
        voice,
        started=started,
        report=options.json,
        ends=options.once or options.headless,
        page=page,
    )
    try:
        end = supervisor.run(stop)
    finally:
        supervisor.stop()
        voice.close()
    if end is None:
        return Exit.INTERRUPTED if options.once else Exit.DONE
    if end.line:
        with contextlib.suppress(OSError):
            sys.stderr.write(f"retouch: {end.line}\n")
    return end.code


def _page(configuration: Configuration, options: Launch) -> Page | None:
    """The page that belongs to the run; what forbids to open it is said before anything is started."""
    if not options.page:
        return None
    asks(configuration)
    return Page(secured(configuration), opens=options.browser)


def _await_ports(configuration: Configuration, options: Launch) -> None:
    """Let pass where the run can listen; what another one holds is said before anything is started."""
    deadline = time.monotonic() + FREED_S
    while True:
        try:
            check_ports(configuration, options)
        except (EndpointInUse, PortInUse):
            if time.monotonic() > deadline:
                raise
            time.sleep(POLL_S)
        else:
            return


def check_ports(configuration: Configuration, options: Launch) -> None:
    """Let pass where everything that is to be started could listen now.

    Raises:
        EndpointInUse: the router could not.
        PortInUse: a page could not.
    """
    station, viewer = configuration.station, configuration.viewer
    endpoint = parse(configuration.listen)
    if options.router and endpoint.protocol in OVER_TCP and endpoint.is_address:  # a name's the router looks up
        try:
            check_port("the router", endpoint.host, endpoint.port, "--listen")
        except PortInUse:
            raise EndpointInUse(configuration.listen) from None
    if "station" in options.processes and not options.headless:
        check_port("the operator's page", station.host, station.port, "[station] port")
    if "viewer" in options.processes:
        check_port("the viewer's page", viewer.host, viewer.web_port, "[viewer] web_port")
        check_port("the live stream", viewer.host, viewer.stream_port, "[viewer] stream_port")


def _run_folder(parent: Path) -> Path:
    stamp = datetime.now(UTC).strftime("%Y%m%d-%H%M%S")
    for suffix in ("", *(f"-{i}" for i in range(2, 100))):
        folder = parent / f"{stamp}{suffix}"
        try:
            folder.mkdir(parents=True)
        except FileExistsError:
            continue
        except OSError as error:
            raise FolderUnusable(folder, FOLDER_SETTING, error.strerror or str(error)) from None
        return folder.resolve()
    raise CommandFailed(f"cannot make a folder for this run in {parent}")


def _for_run(configuration: Configuration, folder: Path, options: Launch) -> Configuration:
    viewer = msgspec.structs.replace(configuration.viewer, folder=str(folder))
    model = msgspec.structs.replace(configuration.model, run=str(folder))
    if options.fresh:
        model = msgspec.structs.replace(model, database=str(folder / "model.sqlite"))
    return msgspec.structs.replace(configuration, viewer=viewer, model=model)


def _jobs(options: Launch, resolved: Path) -> list[Job]:
    configured = ("--config", str(resolved))
    joined = ("--connect", options.upstream) if options.upstream else ()
    jobs = [Job(ROUTER, (ROUTER, *configured, *joined))] if options.router else []
    jobs += [Job(name, (name, *configured)) for name in options.processes]
    if "model" in options.processes and not options.untaught:
        jobs.append(Job(TEACHER, (TEACHER, *configured), restart=False))
    return jobs
