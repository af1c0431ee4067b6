"""Who each end is: this machine's certificate, and what a real handshake with the router's says."""

from __future__ import annotations

from collections.abc import Iterator

from cryptography import x509

from services.bus.zenoh import open_session
from services.certificates import register
from services.certificates.credentials import Credentials, credentials
from services.certificates.exceptions import CertificateMissing
from services.commands.doctor.case import Case
from services.commands.doctor.finding import Finding, Verdict, look, ok, wrong
from services.commands.doctor.handshake import Outcome, shake_hands, shown
from services.commands.doctor.own import CERTIFICATE, common_name, examined
from services.process.endpoint import Endpoint
from services.process.exceptions import BusError

OPENED_WITHIN_S = 1.5
"""A router that speaks without TLS, on a way that was just found open."""


def check_certificate(case: Case) -> Iterator[Finding]:
    """This machine's certificate, then the handshake."""
    endpoint = case.endpoint
    if not endpoint.secure:
        yield _open(endpoint)
        return
    try:
        mine = credentials(case.configuration, endpoint.text)
    except CertificateMissing as error:
        yield wrong(CERTIFICATE, f"{error.folder} holds none for {' or '.join(error.wanted)}", error.remedy)
        return
    assert mine is not None  # a secured endpoint needs one
    own = examined(mine, register.now())
    yield own
    if own.verdict is Verdict.WRONG:
        return
    case.shown = mine
    if case.trip_s is None:
        return
    if endpoint.protocol != "tls":
        yield ok(CERTIFICATE, f"what the router says of it shows when a session opens over {endpoint.protocol}")
        return
    try:
        yield _met(endpoint, mine, case.trip_s)
    except OSError as error:
        yield wrong(CERTIFICATE, f"{mine.file} cannot be used: {error}", "copy it here again from where it was issued")


def _open(endpoint: Endpoint) -> Finding:
    if endpoint.is_loopback:
        return ok(CERTIFICATE, f"none is asked for: nobody else reaches {endpoint.host} of this machine")
    told = f"none is asked for over {endpoint.protocol}: whoever reaches this network can listen in and command"
    return look(CERTIFICATE, told, "'retouch certs --help' tells how certificates are made")


def _met(endpoint: Endpoint, mine: Credentials, trip_s: float) -> Finding:
    """What the handshake says."""
    handshake = shake_hands(endpoint, mine, trip_s)
    match handshake.outcome:
        case Outcome.MET:
            return ok(CERTIFICATE, f"this machine and the router at {endpoint.host} know each other's authority")
        case Outcome.REFUSED:
            return _refused(mine, handshake.reason)
        case Outcome.SILENT | Outcome.NO_TLS:
            return _no_tls(endpoint, handshake.reason)
        case outcome:
            return _distrusted(endpoint, outcome, handshake.reason)


def _refused(mine: Credentials, reason: str) -> Finding:
    """The router lets this machine's certificate not in."""
    told = f"the router refuses {mine.subject} ({reason})"
    if "expired" in reason:
        return wrong(CERTIFICATE, told, "it has ended by the router's clock: compare the clocks, or renew it")
    remedy = f"it trusts another authority than {mine.root}: give both certificates of the same one"
    return wrong(CERTIFICATE, told, remedy)


def _no_tls(endpoint: Endpoint, reason: str) -> Finding:
    """Whoever listens does not speak TLS."""
    plain = endpoint.text.replace("tls/", "tcp/", 1)
    if _speaks_plainly(plain):
        told = "a router listens there that speaks without TLS"
        remedy = f"let it listen on {endpoint.text}, with a certificate; or connect to {plain}, as it is"
        return wrong(CERTIFICATE, told, remedy)
    remedy = "does another program have that port? Look there, with 'ss -ltnp'"
    return wrong(CERTIFICATE, f"what listens there does not answer with TLS: {reason}", remedy)


def _speaks_plainly(plain: str) -> bool:
    try:
        open_session(plain, OPENED_WITHIN_S, tell=lambda line: None).close()
    except BusError:
        return False
    return True


def _distrusted(endpoint: Endpoint, outcome: Outcome, reason: str) -> Finding:
    """The router's certificate does not convince this machine."""
    theirs = shown(endpoint)
    name = _name(theirs)
    match outcome:
        case Outcome.OTHER_AUTHORITY:
            remedy = "both need certificates of one authority ('retouch certs issue'), with its ca.pem"
            return wrong(CERTIFICATE, f"the router's ({name}) was issued by another authority ({reason})", remedy)
        case Outcome.ENDED:
            until = f" on {theirs.not_valid_after_utc:%Y-%m-%d %H:%M} UTC" if theirs is not None else ""
            told = f"the router's ({name}) has ended{until}, here it is {register.now():%Y-%m-%d %H:%M} UTC"
            return wrong(CERTIFICATE, told, f"'retouch certs renew {name}', copy it there, and start the router again")
        case Outcome.NOT_YET_VALID:
            return wrong(CERTIFICATE, f"the router's ({name}) is not valid yet, by this clock", "set this clock")
        case Outcome.OTHER_NAME:
            told = f"the router's ({name}) is not for {endpoint.host}, but for {_hosts(theirs)}"
            remedy = f"connect to one of these, or revoke it and issue it again with --host {endpoint.host}"
            return wrong(CERTIFICATE, told, remedy)
        case _:
            return wrong(CERTIFICATE, f"the router's ({name}) cannot be trusted: {reason}", "issue it again")


def _name(theirs: x509.Certificate | None) -> str:
    named = common_name(theirs).partition("~")[0] if theirs is not None else ""
    return named or "without a name"


def _hosts(theirs: x509.Certificate | None) -> str:
    """Under which it may be reached."""
    if theirs is None:
        return "others"
    try:
        names = theirs.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    except x509.ExtensionNotFound:
        return "none at all: it is no router's"
    return ", ".join(str(name.value) for name in names)
