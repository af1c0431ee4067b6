"""With which certificate a process joins a network, and where none is needed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from protocol.exceptions import InvalidName
from protocol.rights import KINDS, Subject, subject
from services.certificates.exceptions import CertificateMissing, Unsecured
from services.certificates.register import Register, load
from services.process.config import Configuration
from services.process.endpoint import Endpoint, parse
from services.process.files import settings_folder
from services.process.processes import NOBODY_IN_PARTICULAR

FOLDER = "certs"
"""Of a machine's certificates, in its user's folder of settings."""

ROOT = "ca.pem"

_ROUTER = next(kind for kind in KINDS if kind.routes)

TOOL = "cli"
"""The role of what a person starts at a terminal to look, or to stop a robot."""

TOOLS = (TOOL, "teach", "history")
"""Which are gone when they have done what they were started for."""


@dataclass(frozen=True)
class Credentials:
    """A certificate and its key in one file, and whom else it lets one trust.

    Attributes:
        folder: of the machine's certificates.
        subject: whom it is for.
    """

    folder: Path
    subject: Subject

    def process(self, role: str) -> str:
        """What a tool of that role is called on the network."""
        return self.subject.process(role) if self.subject.kind.person else f"{role}-{self.subject.kind.name}"

    @property
    def root(self) -> Path:
        """The authority's certificate."""
        return self.folder / ROOT

    @property
    def file(self) -> Path:
        """The certificate and its key; replaced where it is renewed."""
        return self.folder / f"{self.subject}.pem"

    def register(self) -> Register:
        """Whom a router lets in, as it stands in the folder now; raises Unreadable."""
        return load(self.folder)


def folder(configured: str) -> Path:
    """Where this machine's certificates are.

    Raises:
        FolderUnusable: there is no folder for a user's settings.
    """
    return Path(configured).expanduser() if configured else settings_folder() / FOLDER


def check_secured(configuration: Configuration, text: str) -> None:
    """Let an endpoint pass that nobody else can reach or listen in on, or of which it was said that it may be open.

    Raises:
        BadEndpoint: it is none.
        Unsecured: it is open to others, and nobody said so.
    """
    endpoint = parse(text)
    if endpoint.secure or endpoint.is_loopback or configuration.insecure:
        return
    right = f"give {text.replace(endpoint.protocol, 'tls', 1)} and certificates ('retouch certs --help')"
    raise Unsecured(text, f"{endpoint.protocol} carries whatever anybody sends", right)


def is_open(configuration: Configuration) -> bool:
    """Whether others can listen in on this network, and command on it."""
    ends = (parse(configuration.connect), parse(configuration.listen))
    return configuration.insecure and any(not end.secure and not end.is_loopback for end in ends)


def present(configuration: Configuration) -> str:
    """Who is here: the only person that the folder has a certificate for, where nobody says so."""
    if configuration.operator != NOBODY_IN_PARTICULAR or not parse(configuration.connect).secure:
        return configuration.operator
    people = {one.name for one in subjects_in(folder(configuration.tls)) if one.kind.person}
    return people.pop() if len(people) == 1 else configuration.operator


def credentials(
    configuration: Configuration, text: str, role: str = TOOL, *, revokes: bool = False
) -> Credentials | None:
    """With which certificate a process dials an endpoint, or listens on it; None where none is needed.

    Args:
        configuration: of the whole system.
        text: the endpoint.
        role: of the process.
        revokes: it is about to end somebody's authority.

    Raises:
        Unsecured: see `check_secured`.
        CertificateMissing: the folder holds none for it.
    """
    check_secured(configuration, text)
    endpoint = parse(text)
    if not endpoint.secure:
        return None
    where = folder(configuration.tls)
    there = subjects_in(where)
    wanted = _wanted(configuration, role, there, revokes=revokes)
    found = next((one for one in wanted if one in there), None)
    if found is None:
        raise CertificateMissing(where, tuple(str(one) for one in wanted), _remedy(endpoint, where, there, role))
    return Credentials(where, found)


def _wanted(
    configuration: Configuration, role: str, there: tuple[Subject, ...], *, revokes: bool
) -> tuple[Subject, ...]:
    """In the order in which they are looked for."""
    routers = tuple(one for one in there if one.kind.routes) or (Subject(_ROUTER, configuration.name),)
    if role == _ROUTER.name:
        return routers
    named = tuple(
        Subject(kind, configuration.operator if kind.person else configuration.name)
        for kind in KINDS
        if role in kind.roles and (kind.revokes or not revokes)
    )
    # At a site nobody has to be there for its tools: they use its router's.
    return named + routers if role in TOOLS and not revokes and any(one in there for one in routers) else named


def _remedy(endpoint: Endpoint, where: Path, there: Iterable[Subject], role: str) -> str:
    if not (where / ROOT).exists():
        return f"{endpoint.protocol} needs them; 'retouch certs --help' tells how they are made, --tls FOLDER where"
    people = {one.name for one in there if one.kind.person and role in one.kind.roles}
    if people:
        return f"say who is here with --operator {' or '.join(sorted(people))}, or issue it"
    return "issue it with 'retouch certs issue' where the authority is, and copy it here"


def subjects_in(where: Path) -> tuple[Subject, ...]:
    """For whom a folder holds certificates."""
    found = []
    for file in sorted(where.glob("*.*.pem")):
        try:
            found.append(subject(file.name.removesuffix(".pem")))
        except InvalidName:
            continue  # somebody else's
    return tuple(found)
