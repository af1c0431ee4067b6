"""Who is there: the robots and their processes, and whether they speak the same version as this machine."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from protocol.names import role
from protocol.topic import VERSION
from services.commands.doctor.case import Case
from services.commands.doctor.finding import Finding, Verdict, look, ok, wrong
from services.commands.doctor.hearing import LISTEN_S, Beat, Hearing
from services.process.release import release

PROCESSES, SOFTWARE = "processes", "version"

AT_THE_ROBOT = ("robot", "camera", "perception", "model")
"""What is needed beside it."""


def check_processes(case: Case) -> Iterator[Finding]:
    """Listen for a while, then say who was heard."""
    with case.joined() as session:  # of its own: what is heard here must not be in the way of what is measured later
        case.hearing.listen(session, case.configuration.name, case.clock)
        case.wait(LISTEN_S)
    yield from present(case.hearing.robots, case.configuration.name)


def present(robots: Mapping[str, Mapping[str, Beat]], name: str) -> Iterator[Finding]:
    """Who is there.

    Args:
        robots: the processes that were heard, of each robot.
        name: of the robot that is meant.
    """
    start = f"start it there: 'retouch up --robot {name} --only {','.join(AT_THE_ROBOT)}'"
    if not robots:
        yield wrong(PROCESSES, "no process of any robot was heard", start)
        return
    for robot, processes in robots.items():
        if robot != name:
            yield ok(PROCESSES, f"{robot} is there: {_listed(processes)}")
    own = robots.get(name, {})
    missing = [one for one in AT_THE_ROBOT if one not in {role(process) for process in own}]
    others = [robot for robot in robots if robot != name and "robot" in {role(process) for process in robots[robot]}]
    if "robot" in missing:
        there = f", only {_listed(own)}" if own else ""
        remedy = f"{start}; or say --robot {' or '.join(others)}" if others else start
        yield wrong(PROCESSES, f"robot {name} is not there{there}", remedy)
    elif missing:
        told = f"{name} is there: {_listed(own)}; not there: {', '.join(missing)}"
        yield look(PROCESSES, told, f"where they belong: 'retouch up --robot {name} --only {','.join(missing)}'")
    else:
        yield ok(PROCESSES, f"{name} is there: {_listed(own)}")


def _listed(processes: Mapping[str, Beat]) -> str:
    """By the machines that they run on."""
    hosts: dict[str, list[str]] = {}
    for process, beat in processes.items():
        hosts.setdefault(beat.message.host, []).append(process)
    return "; ".join(f"{', '.join(names)} on {host}" for host, names in hosts.items())


def check_version(case: Case) -> Iterator[Finding]:
    """Whether everybody speaks as this machine does."""
    yield from versions(case.hearing, release(), sealed=case.shown is not None)


def versions(hearing: Hearing, own: str, *, sealed: bool) -> Iterator[Finding]:
    """Who speaks another version.

    Args:
        hearing: what was heard.
        own: the release here.
        sealed: the router lets pass only what the tables of its own version say.
    """
    if not hearing.foreign and not hearing.robots:
        yield Finding(Verdict.NOT_MADE, SOFTWARE, "nobody was heard")
        return
    same = True
    for one in sorted(hearing.foreign, key=lambda one: (one.robot, one.process)):
        same = False
        told = f"{one.process} of {one.robot} speaks {one.speaks}, which nobody of {VERSION} reads"
        yield wrong(SOFTWARE, told, "install the same release of Retouch on both machines")
    for robot, processes in hearing.robots.items():
        for process, beat in processes.items():
            other = beat.message.software
            if other != own and other:
                same = False
                told = f"{process} of {robot} runs release {other}, here it is {own or 'not installed as a package'}"
                yield look(SOFTWARE, told, "the same one everywhere is what is tested")
            dropped = {figures.topic: figures.wrong_version for figures in beat.message.topics if figures.wrong_version}
            if dropped:
                same = False
                told = ", ".join(f"{count} on {topic}" for topic, count in dropped.items())
                remedy = "somebody speaks another version: is an old process still running?"
                yield look(SOFTWARE, f"{process} of {robot} dropped messages of another version: {told}", remedy)
    if same:
        limits = "; of another one a router with certificates passes nothing on" if sealed else ""
        yield ok(SOFTWARE, f"everybody who was heard speaks {VERSION}{f', release {own}' if own else ''}{limits}")
