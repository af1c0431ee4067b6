"""Who may publish, read, ask and answer what, by the name in a certificate: derived from topics and queries.

A certificate is called `KIND.NAME`: that of one of a robot's processes names the robot (`camera.kitchen`), a person's
the person (`operator.anna`), whose processes may speak to every robot, a router's its site. A page's (`page.desk`) lets
browsers know it, and joins no network. What is not granted here is denied.
"""

from __future__ import annotations

import enum
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from protocol.commander import EVERYBODY, commander_keys
from protocol.exceptions import InvalidName
from protocol.names import checked_name, process_name
from protocol.queries import QUERIES, REVOKE, Query
from protocol.topic import VERSION, Topic
from protocol.topics import TOPICS

ANY = "*"
"""Every robot, or every process, in a key expression."""

COMMANDING = ("cmd", "authority")
"""Classes of topics and queries that only who commands speaks on."""


class Act(enum.Enum):
    """What somebody does with a key."""

    PUBLISH = "publish"
    READ = "read"
    ASK = "ask"
    ANSWER = "answer"
    BE_THERE = "be there"
    SEE = "see who is there"


@dataclass(frozen=True)
class Kind:
    """A kind of certificate.

    Attributes:
        name: the first part of the certificate's.
        roles: of the processes that use it.
        person: it is a person's, at every robot; otherwise it is one robot's.
        commands: it may move robots and teach them.
        revokes: it may end the authority of whoever commands.
        routes: it passes on whatever there is.
        page: it vouches for a page to browsers, and has no place on a network.
    """

    name: str
    roles: tuple[str, ...]
    person: bool = False
    commands: bool = False
    revokes: bool = False
    routes: bool = False
    page: bool = False

    @property
    def dialled(self) -> bool:
        """Whether others reach it under hosts' names, which its certificate has to say."""
        return self.routes or self.page


_AT_THE_DESK = ("station", "viewer", "cli", "history")

KINDS: tuple[Kind, ...] = (
    Kind("router", (), routes=True),
    Kind("robot", ("robot",)),
    Kind("camera", ("camera",)),
    Kind("perception", ("perception",)),
    Kind("model", ("model",)),
    Kind("operator", ("master", *_AT_THE_DESK, "teach", "study"), person=True, commands=True),
    Kind("observer", _AT_THE_DESK, person=True),
    Kind("supervisor", _AT_THE_DESK, person=True, revokes=True),
    Kind("page", (), page=True),
)

SITE = tuple(kind.name for kind in KINDS if not kind.person and not kind.page)
"""What one robot's site needs."""


@dataclass(frozen=True)
class Subject:
    """Whom a certificate is for.

    Attributes:
        kind: of the certificate.
        name: of the robot, the person or the site.
    """

    kind: Kind
    name: str

    def __str__(self) -> str:
        return f"{self.kind.name}.{self.name}"

    @property
    def robot(self) -> str:
        """To which robot it may speak; `ANY` for every one."""
        return ANY if self.kind.person else self.name

    def process(self, role: str) -> str:
        """Its process of that role, as it is called on the network."""
        return process_name(role, self.name) if self.kind.person else role


@dataclass(frozen=True)
class Right:
    """One act on one key expression."""

    act: Act
    key: str


def subject(text: str) -> Subject:
    """Whom a certificate of this name is for.

    Raises:
        InvalidName: it is no name of a certificate.
    """
    kind, dot, name = text.partition(".")
    known = next((one for one in KINDS if one.name == kind), None)
    if known is None or not dot:
        raise InvalidName(text)
    return Subject(known, checked_name(name))


def rights(one: Subject) -> Iterator[Right]:
    """All that a certificate's processes may do; a router's is asked nothing."""
    if one.kind.routes:
        return
    if one.kind.person:
        yield Right(Act.READ, f"retouch/{VERSION}/**")
        yield Right(Act.SEE, EVERYBODY)
    for topic in TOPICS:
        yield from _on_topic(one, topic)
    for query in QUERIES:
        yield from _on_query(one, query)
    for role in one.kind.roles:
        yield Right(Act.BE_THERE, f"retouch/{VERSION}/{one.robot}/alive/{one.process(role)}")
    if "robot" in one.kind.roles:
        yield Right(Act.BE_THERE, commander_keys(one.robot))


def _on_topic(one: Subject, topic: Topic[Any]) -> Iterator[Right]:
    if set(one.kind.roles) & set(topic.readers):
        yield Right(Act.READ, _key(one, topic.name, ANY))
    if one.kind.person and not one.kind.commands and _class(topic.name) in COMMANDING:
        return
    for role in one.kind.roles:
        if topic.publisher in ("any", role):
            yield Right(Act.PUBLISH, _key(one, topic.name, one.process(role)))


def _on_query(one: Subject, query: Query[Any, Any]) -> Iterator[Right]:
    if query.server in one.kind.roles:
        yield Right(Act.ANSWER, _key(one, query.name, f"{query.server}/{ANY}"))
    if not _may_ask(one.kind, query):
        return
    for role in one.kind.roles:
        if role in query.askers:
            yield Right(Act.ASK, _key(one, query.name, f"{query.server}/{one.process(role)}"))


def _may_ask(kind: Kind, query: Query[Any, Any]) -> bool:
    if query is REVOKE:
        return kind.revokes
    return kind.commands or (kind.person and query.looks)


def _key(one: Subject, name: str, rest: str) -> str:
    return f"retouch/{VERSION}/{one.robot}/{name}/{rest}"


def _class(name: str) -> str:
    return name.partition("/")[0]
