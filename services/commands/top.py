"""`retouch top`: the live processes of a network."""

from __future__ import annotations

import time
from argparse import ArgumentParser, Namespace
from dataclasses import astuple

from rich.console import Group
from rich.live import Live
from rich.table import Table
from rich.text import Text

from protocol.codec import decode
from protocol.exceptions import ProtocolError
from protocol.messages import Figure, Heartbeat
from protocol.names import person, process_name, role
from protocol.topic import VERSION
from protocol.topics import HEARTBEAT
from services.bus.stages import NAMES, Lasting, Stages, from_figures, merged
from services.bus.zenoh import Passing, open_session, watch
from services.certificates.credentials import credentials
from services.commands.arguments import add_network
from services.commands.settings import configuration
from services.commands.terminal import Terminal
from services.process.clock import SystemClock
from services.process.config import Configuration
from services.process.ending import end_within
from services.process.lines import readable
from services.process.runner import stop_on_signals

GONE_AFTER_S = 5.0


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    add_network(parser)
    parser.add_argument("--once", action="store_true", help="print one table and end")


def run(arguments: Namespace) -> int:
    """See `Action`."""
    top(configuration(arguments), once=arguments.once)
    return 0


class Beats:
    """The newest heartbeat of each process, and when it came."""

    def __init__(self) -> None:
        self._newest: dict[tuple[str, str], tuple[Heartbeat, float, float]] = {}
        self._stages: dict[tuple[str, str], Lasting] = {}
        self._clock = SystemClock()

    def receive(self, passing: Passing) -> None:
        """Keep a heartbeat; what is none is passed over."""
        try:
            beat = decode(HEARTBEAT, passing.payload, passing.schema)
        except ProtocolError:
            return
        robot = passing.key.split("/")[2]
        now_ns = self._clock.now_ns()
        self._stages.setdefault((robot, beat.process), Lasting()).see(from_figures(beat.figures), now_ns)
        now = now_ns / 1e9
        previous = self._newest.get((robot, beat.process))
        share = 0.0
        if previous is not None and previous[0].pid == beat.pid and now > previous[1]:
            share = (beat.cpu_s - previous[0].cpu_s) / (now - previous[1])
        self._newest[(robot, beat.process)] = (beat, now, share)

    def shown(self) -> Group:
        """The processes, and below them what they measure."""
        return Group(self.table(), self.measured(), *self.paths())

    def paths(self) -> tuple[Text, ...]:
        """A line for each operator of a robot: how long what the hand does takes, from stage to stage."""
        lines = []
        now_ns = self._clock.now_ns()
        for robot, by_process in self._figures().items():
            known = {name: self._stages[robot, name].at(now_ns) for name in by_process}
            for who in sorted({person(name) for name in known if role(name) in ("master", "station")}):
                names = ("robot", *(process_name(one, who) if who else one for one in ("master", "station")))
                path = merged(known[name] for name in names if name in known)
                lines.append(Text(readable(f"{robot}{f', {who}' if who else ''}: {told(path)}")))
        return tuple(lines)

    def measured(self) -> Table:
        """A row a process: what else it measures."""
        table = Table("robot", "process", "measures", box=None, pad_edge=False)
        for robot, by_process in self._figures().items():
            for name, own in by_process.items():
                each = ", ".join(f"{figure.name} {figure.value:.3g} {figure.unit}".rstrip() for figure in own)
                if each:
                    table.add_row(Text(readable(robot)), Text(readable(name)), Text(readable(each)))
        return table

    def _figures(self) -> dict[str, dict[str, tuple[Figure, ...]]]:
        """What those measure that are there, by robot and process."""
        now = self._clock.now_ns() / 1e9
        found: dict[str, dict[str, tuple[Figure, ...]]] = {}
        for (robot, name), (beat, seen, _) in sorted(self._newest.items()):
            if now - seen <= GONE_AFTER_S:
                found.setdefault(robot, {})[name] = beat.figures
        return found

    def table(self) -> Table:
        """A row a process, a row a topic that it receives."""
        table = Table(title="retouch top", expand=False)
        for heading in (
            "robot",
            "process",
            "host:pid",
            "Hz",
            "late",
            "CPU",
            "MB",
            "receives",
            "rate",
            "age",
            "latency",
        ):
            table.add_column(heading, justify="left" if heading in ("robot", "process", "receives") else "right")
        table.add_column("drops", justify="right")
        now = self._clock.now_ns() / 1e9
        for (robot, name), (beat, seen, share) in sorted(self._newest.items()):
            gone = now - seen > GONE_AFTER_S
            style = "dim" if gone else ""
            late = f"{100 * beat.late_ticks / max(1, beat.ticks):.1f} %"
            head = [robot, name + (" (gone)" if gone else ""), f"{beat.host}:{beat.pid}", f"{beat.rate_hz:g}", late]
            head += [f"{100 * share:.0f} %", f"{beat.memory / 1e6:.0f}"]
            topics = [
                [t.topic, f"{t.rate_hz:.0f}", _seconds(t.age), _seconds(t.latency), str(t.drops)] for t in beat.topics
            ]
            for i, row in enumerate(topics or [[""] * 5]):
                table.add_row(*(head if i == 0 else [""] * len(head)), *row, style=style)
        return table


def told(path: Stages) -> str:
    """A path's stages in their order, and from hand to eye, as far as they are known."""
    each = zip(NAMES, astuple(path), strict=True)
    stages = ", ".join(f"{name} {'?' if value is None else f'{1e3 * value:.0f} ms'}" for name, value in each)
    if not path.known:
        return f"from hand to eye nothing is known yet ({stages})"
    return f"from hand to eye {'' if path.complete else 'at least '}{1e3 * path.total:.0f} ms: {stages}"


def _seconds(value: float) -> str:
    return "-" if value < 0 else f"{1e3 * value:.1f} ms"


def top(configuration: Configuration, *, once: bool) -> None:
    """Show until interrupted, or one table after a few heartbeats.

    Raises:
        BusError: there is no such network.
    """
    stop = stop_on_signals()
    end_within()
    shown = credentials(configuration, configuration.connect)
    session = open_session(configuration.connect, 5.0, stop, credentials=shown)
    beats = Beats()
    console = Terminal(width=None if Terminal().is_terminal else 160)
    try:
        watch(session, f"retouch/{VERSION}/*/{HEARTBEAT.name}/*", beats.receive)
        if once:
            stop.wait(2.5 / HEARTBEAT.rate_hz)
            console.print(beats.shown())
            return
        with Live(beats.shown(), console=console, screen=console.is_terminal) as live:
            while not stop.is_set():
                time.sleep(0.5)
                live.update(beats.shown())
    finally:
        session.close()
