"""A TLS handshake with whoever listens, as the transport makes it: what each end says of the other's certificate."""

from __future__ import annotations

import contextlib
import socket
import ssl
from dataclasses import dataclass
from enum import Enum, auto

from cryptography import x509

from services.certificates.credentials import Credentials
from services.process.endpoint import Endpoint

WITHIN_S = 2.0

REFUSED_WITHIN_S = 0.3
"""Beyond three round trips: a server that refuses a certificate says so only after the handshake, at the first read."""

TRIPS = 3


class Outcome(Enum):
    """How it ended."""

    MET = auto()
    OTHER_AUTHORITY = auto()
    ENDED = auto()
    NOT_YET_VALID = auto()
    OTHER_NAME = auto()
    REFUSED = auto()
    NO_TLS = auto()
    SILENT = auto()
    FAILED = auto()


_OF_CODE = {
    **dict.fromkeys((7, 18, 19, 20, 21), Outcome.OTHER_AUTHORITY),
    9: Outcome.NOT_YET_VALID,
    10: Outcome.ENDED,
    **dict.fromkeys((62, 63, 64), Outcome.OTHER_NAME),
}
"""OpenSSL's numbers of what is wrong with a certificate (X509_V_ERR_...)."""


@dataclass(frozen=True)
class Handshake:
    """How it ended.

    Attributes:
        outcome: in one word.
        reason: as the library says it; empty where both ends are content.
    """

    outcome: Outcome
    reason: str = ""


def shake_hands(endpoint: Endpoint, credentials: Credentials, trip_s: float) -> Handshake:
    """Meet whoever listens at an endpoint.

    Args:
        endpoint: where.
        credentials: of this machine.
        trip_s: there and back [s].

    Raises:
        OSError: a file of the credentials cannot be used, ssl.SSLError among it.
    """
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.load_verify_locations(credentials.root)
    context.load_cert_chain(credentials.file)
    try:
        with (
            socket.create_connection((endpoint.host, endpoint.port), WITHIN_S) as plain,
            context.wrap_socket(plain, server_hostname=endpoint.host) as secured,
        ):
            return _heard(secured, max(REFUSED_WITHIN_S, TRIPS * trip_s))
    except ssl.SSLCertVerificationError as error:
        return Handshake(_OF_CODE.get(error.verify_code, Outcome.FAILED), error.verify_message)
    except TimeoutError:
        return Handshake(Outcome.SILENT, "it accepted, and said nothing")
    except (ssl.SSLError, OSError) as error:
        return Handshake(Outcome.NO_TLS, _reason(error))


def _heard(secured: ssl.SSLSocket, within_s: float) -> Handshake:
    """What the server says after it was shown the certificate: a router waits, and says nothing."""
    secured.settimeout(within_s)
    try:
        secured.recv(1)
    except TimeoutError:
        return Handshake(Outcome.MET)
    except OSError as error:
        return Handshake(Outcome.REFUSED, _reason(error))
    return Handshake(Outcome.REFUSED, "it hung up")


def _reason(error: OSError) -> str:
    """In words, such as "tlsv1 alert unknown ca"."""
    named = error.reason if isinstance(error, ssl.SSLError) else error.strerror
    return (named or str(error)).lower().replace("_", " ")


def shown(endpoint: Endpoint) -> x509.Certificate | None:
    """The certificate of whoever listens, whatever it is worth; None where none is shown."""
    with contextlib.suppress(OSError, ValueError):
        text = ssl.get_server_certificate((endpoint.host, endpoint.port), timeout=WITHIN_S)
        return x509.load_pem_x509_certificate(text.encode())
    return None
