"""A session with the router, and whether it passes on what this machine says."""

from __future__ import annotations

import os
from collections.abc import Iterator

from protocol.topics import PROBE
from services.bus.zenoh import Lanes, ZenohBus
from services.certificates.credentials import TOOL
from services.certificates.register import REGISTER
from services.commands.doctor.case import Case
from services.commands.doctor.finding import Finding, ok, wrong
from services.commands.doctor.handshake import shown
from services.process.exceptions import BusError, RouterUnreachable

ROUTER, ENTRY = "router", "entry"


def check_router(case: Case) -> Iterator[Finding]:
    """A session opens."""
    endpoint = case.endpoint
    name = case.shown.process(TOOL) if case.shown is not None else f"{TOOL}-{os.getpid()}"
    try:
        case.speaker, case.hearer = _process(case, name), _process(case, name)
    except RouterUnreachable as error:
        yield _unopened(case, error.reason)
        return
    except BusError as error:
        yield wrong(ROUTER, str(error), "look at the endpoint")
        return
    yield ok(ROUTER, f"a router answers at {endpoint.text}, and is known here as {name}")


def _process(case: Case, name: str) -> ZenohBus:
    """A process of the doctor's own, until the examination ends."""
    session = case.open.enter_context(case.joined())
    bus = ZenohBus(Lanes(session), case.configuration.name, name, case.clock)
    case.open.callback(bus.close)
    return bus


def _unopened(case: Case, reason: str) -> Finding:
    endpoint = case.endpoint
    if endpoint.protocol == "tcp" and shown(endpoint) is not None:
        secured = endpoint.text.replace("tcp/", "tls/", 1)
        return wrong(ROUTER, "what listens there speaks TLS", f"connect to {secured}, with a certificate")
    return wrong(ROUTER, f"no session opens: {reason}", "is it a router of this software? Does it run as it should?")


def check_entry(case: Case) -> Iterator[Finding]:
    """What this machine says comes back through the router: a router is silent to whom it lets do nothing."""
    assert case.hearer is not None
    case.heard = case.hearer.subscribe(PROBE)
    if case.comes_back(PROBE, case.heard):
        yield ok(ENTRY, "the router passes on what this machine says, and lets it hear")
    else:
        yield _unheard(case)


def _unheard(case: Case) -> Finding:
    if case.shown is None:
        return wrong(
            ENTRY, "nothing comes back that is sent to the router", "start the router again; is it overloaded?"
        )
    told = f"the router lets {case.shown.subject} in, and lets it do nothing: revoked, or issued after its register"
    return wrong(
        ENTRY, told, f"copy the authority's {REGISTER} beside the router's certificate; revoked: issue it anew"
    )
