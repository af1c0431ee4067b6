"""A request that one process answers, as data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, TypeVar

import msgspec

from protocol.names import checked_name
from protocol.topic import VERSION

Req = TypeVar("Req", bound=msgspec.Struct)
Rep = TypeVar("Rep", bound=msgspec.Struct)


@dataclass(frozen=True)
class Query(Generic[Req, Rep]):
    """A request that one process answers.

    Attributes:
        name: "<class>/<subject>".
        request: its type.
        reply: the type of a positive answer; the negative one is always `Refused`.
        server: the process that answers.
        max_bytes: of a request or a reply.
        about: one line for people.
        askers: the processes that ask it, by their roles.
        looks: it changes nothing: whoever looks on may ask it too.
    """

    name: str
    request: type[Req]
    reply: type[Rep]
    server: str
    max_bytes: int
    about: str
    askers: tuple[str, ...] = ("station",)
    looks: bool = False

    @property
    def schema(self) -> str:
        """Announced with every request."""
        return f"{self.request.__name__}/1"

    def key(self, robot: str, asker: str = "*") -> str:
        """The key expression at which the robot's server answers a process; by default every one."""
        place = f"retouch/{VERSION}/{checked_name(robot)}/{self.name}/{self.server}"
        return f"{place}/{asker if asker == '*' else checked_name(asker)}"
