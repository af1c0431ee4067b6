"""What a topic is: a channel of one message type, how it travels, and the keys on which it does."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property, lru_cache
from typing import Generic, TypeVar

from protocol import messages
from protocol.names import checked_name, is_name, role

M = TypeVar("M", bound=messages.Message)

VERSION = "@v1"
"""The verbatim chunk keeps versions apart: no wildcard of one version matches another."""


class QoS(Enum):
    """How a topic travels, named by stance; the bus translates it.

    SAFETY: before everything else, at once; every message counts, however late and whatever its stamp.
    REALTIME: the newest sample only, at once, rather lost than late.
    STATE: the newest sample only, ahead of pictures.
    PICTURE: large, the newest only, behind everything that moves.
    EVENT: every message counts, however late; its publisher repeats what must not be lost.
    """

    SAFETY = "safety"
    REALTIME = "realtime"
    STATE = "state"
    PICTURE = "picture"
    EVENT = "event"


@dataclass(frozen=True)
class Topic(Generic[M]):
    """A channel of one message type, or a family of them.

    Attributes:
        name: "<class>/<subject>"; access rules name the class: cmd, state, model, cam, safety, authority, health. That
            of a family ends in "/*", where the name of each of its members stands; see `of`.
        type: of its messages.
        rate_hz: at which it is published in operation; timeouts are multiples of its period.
        qos: how it travels.
        publisher: the process that publishes it; "any" where every process may.
        max_bytes: of an encoded message.
        about: one line for people.
        kept: messages that a receiver keeps until it takes them; 1 where only the newest counts.
        readers: the robot's own processes that read it, by their roles; people's processes may read everything.
        outdated: a sample that comes late counts for nothing, of a topic that is no event and no stop.
    """

    name: str
    type: type[M]
    rate_hz: float
    qos: QoS
    publisher: str
    max_bytes: int
    about: str
    kept: int = 1
    readers: tuple[str, ...] = ()
    outdated: bool = True

    @cached_property
    def schema(self) -> str:
        """Announced with every message, so that a reader can refuse another version before it decodes."""
        return f"{self.type.__name__}/1"

    @cached_property
    def stale_after_ns(self) -> int | None:
        """Age at which a sample counts as lost: ten periods, at least 100 ms; events and stops never."""
        if self.qos in (QoS.EVENT, QoS.SAFETY) or not self.outdated:
            return None
        return int(max(0.1, 10.0 / self.rate_hz) * 1e9)

    def of(self, member: str) -> Topic[M]:
        """The channel of one member of the family; raises InvalidName where that cannot stand in a key expression."""
        return replace(self, name=self.name.removesuffix("*") + checked_name(member))

    def published_by(self, process: str) -> bool:
        """Whether a process of this name publishes the topic: one of the role that the table names."""
        return publishes(self.publisher, process)

    def key(self, robot: str, source: str) -> str:
        """The key expression on which `source` publishes for `robot`."""
        return source_key(robot, self.name, source)


@lru_cache(maxsize=1024)  # asked with every message; bounded as below
def source_key(robot: str, name: str, source: str) -> str:
    """See `Topic.key`."""
    return f"retouch/{VERSION}/{checked_name(robot)}/{name}/{source if source == '*' else checked_name(source)}"


@lru_cache(maxsize=1024)  # asked of every message, about few names; bounded, since a stranger may invent more
def publishes(publisher: str, process: str) -> bool:
    """See `Topic.published_by`."""
    return is_name(process) and publisher in ("any", role(process))
