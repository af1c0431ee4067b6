"""What this machine may do, and whether a harmless question is answered."""

from __future__ import annotations

from collections.abc import Iterator

from protocol import queries
from protocol.names import role
from protocol.rights import Subject
from services.bus.bus import Failed
from services.commands.doctor.case import Case
from services.commands.doctor.finding import Finding, look, ok, wrong

RIGHTS = "rights"

ANSWER_S = 2.0
POLL_S = 0.02

_MAY = {
    "operator": "may read everything, command any robot whose authority it has, teach it and stop it",
    "observer": "may read everything, ask what was learnt and stop a robot; it leads none: that takes an operator's",
    "supervisor": "may read everything, stop a robot and end the authority of whoever commands; it leads none",
    "router": "is a router's: what it passes on it has judged itself",
}


def check_rights(case: Case) -> Iterator[Finding]:
    """What the certificate allows, then a question to the model, which changes nothing."""
    yield allowed(case.shown.subject if case.shown is not None else None, loopback=case.endpoint.is_loopback)
    yield from _asked(case)


def allowed(subject: Subject | None, *, loopback: bool) -> Finding:
    """What a certificate allows; without one everything is."""
    if subject is not None:
        return ok(RIGHTS, f"{subject} {_MAY[subject.kind.name]}")
    if loopback:
        return ok(RIGHTS, "whoever is on this machine may do everything")
    return look(RIGHTS, "whoever reaches this network may do everything, command too", "use tls/ and certificates")


def _asked(case: Case) -> Iterator[Finding]:
    assert case.speaker is not None
    pending = case.speaker.ask(queries.DESCRIBE, queries.Describe(), ANSWER_S)
    while (outcome := pending.poll()) is None:
        case.wait(POLL_S)
    robot = case.configuration.name
    match outcome:
        case queries.Learnt(state):
            yield ok(RIGHTS, f"the model of {robot} answers: version {state.version} of {state.scene}")
        case queries.Refused(reason):
            yield look(RIGHTS, f"the model of {robot} answers, and refuses to describe itself: {reason}")
        case Failed(reason):
            there = any(role(process) == "model" for process in case.hearing.robots.get(robot, {}))
            if there:
                yield wrong(RIGHTS, f"the model of {robot} is there and does not answer: {reason}", "see its log")
            else:
                yield look(
                    RIGHTS, f"the model of {robot} could not be asked: it is not there", "start it with the robot"
                )
