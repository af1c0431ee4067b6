"""The two sides of a network: a robot's site and an operator's desk, each started from the same file."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import msgspec

from services.process.addresses import EVERYWHERE, in_url
from services.process.config import Configuration
from services.process.exceptions import UnusableSetting
from services.process.processes import PROCESSES


class Side(Enum):
    """Which of them this machine is."""

    SITE = "site"
    DESK = "desk"

    @property
    def processes(self) -> tuple[str, ...]:
        """Their names."""
        return tuple(process.name for process in PROCESSES if process.at_operator is (self is Side.DESK))


@dataclass(frozen=True)
class Placed:
    """What a side of the network is started with.

    Attributes:
        configuration: with its endpoints set.
        router: it has a router of its own.
        upstream: endpoint of the router that its own joins; empty for none.
    """

    configuration: Configuration
    router: bool
    upstream: str


def placed(configuration: Configuration, side: Side) -> Placed:
    """A configuration as that side uses it.

    Raises:
        UnusableSetting: the file does not say where the others are.
    """
    return _site(configuration) if side is Side.SITE else _desk(configuration)


def reachable(listen: str) -> str:
    """The endpoint by which this machine reaches its own router that listens on all addresses."""
    for everywhere, own in EVERYWHERE.items():
        listen = listen.replace(f"/{in_url(everywhere)}:", f"/{in_url(own)}:")
    return listen


def _site(configuration: Configuration) -> Placed:
    site = configuration.site
    if not site.listen and not site.join:
        raise UnusableSetting(
            "[site]", 'there is no router to start, and none to join: give listen = "tls/0.0.0.0:7447", or join'
        )
    if not site.listen:
        return Placed(msgspec.structs.replace(configuration, connect=site.join), router=False, upstream="")
    ends = {"listen": site.listen, "connect": reachable(site.listen)}
    return Placed(msgspec.structs.replace(configuration, **ends), router=True, upstream=site.join)


def _desk(configuration: Configuration) -> Placed:
    desk = configuration.desk
    if not desk.connect:
        raise UnusableSetting("[desk] connect", 'it is not said where the robot is: give "tls/192.0.2.1:7447"')
    if not desk.router:
        return Placed(msgspec.structs.replace(configuration, connect=desk.connect), router=False, upstream="")
    ends = {"connect": configuration.listen}
    return Placed(msgspec.structs.replace(configuration, **ends), router=True, upstream=desk.connect)
