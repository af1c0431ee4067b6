"""The networks that Retouch has to work over, and one run over each."""

import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

from protocol.messages import Coding
from tests.network.link import Link
from tests.network.record import Figures, Record
from tests.network.sites import Sites

RUN_S = 240.0
CUT_AT = 0.4
"""How far a refinement has come when the link is cut."""

HELD_S = 0.4
"""After a cut nothing moves any more; what was on its way has come, and is too old."""


@dataclass(frozen=True)
class Case:
    """One network.

    Attributes:
        name: for people.
        shape: of the link, see `forwarder.Shape`; it is as good as none before.
        pictures: how two cameras code what they send over it; None without any.
        cut_s: how long it is cut in the middle of a refinement [s]; 0 where it is not.
        router: the desk has a router of its own, so that nothing crosses the link twice.
        asleep_s: how long the desk sleeps there [s]; 0 where it does not.
    """

    name: str
    shape: dict = field(default_factory=dict)
    pictures: Coding | None = None
    router: bool = False
    cut_s: float = 0.0
    asleep_s: float = 0.0

    @property
    def path_ms(self):
        return 1e3 * self.shape.get("delay_s", 0.0)


LAN = Case("LAN")
NEAR = {"delay_s": 0.01}
THIN = {"delay_s": 0.05, "jitter_s": 0.01, "loss": 0.01, "rate": 3e6}
CASES = (
    LAN,
    Case("50 +- 10 ms, 1 % lost", {"delay_s": 0.05, "jitter_s": 0.01, "loss": 0.01}),
    Case("150 ms there and back, 3 % lost", {"delay_s": 0.075, "loss": 0.03}),
    Case("reordered and duplicated", {"delay_s": 0.03, "reordered": 0.05, "duplicated": 0.02}),
    Case("15 Mbit/s, two cameras", {"delay_s": 0.02, "jitter_s": 0.002, "rate": 15e6}, pictures=Coding.JPEG),
    Case("3 Mbit/s, two cameras", {"delay_s": 0.02, "jitter_s": 0.002, "rate": 3e6}, pictures=Coding.JPEG, router=True),
    Case("3 Mbit/s, 50 ms, 1 % lost, JPEG", THIN, pictures=Coding.JPEG, router=True),
    Case("3 Mbit/s, 50 ms, 1 % lost, H.264", THIN, pictures=Coding.H264, router=True),
    Case("cut for 0.7 s", NEAR, cut_s=0.7),
    Case("cut for 2 s", NEAR, cut_s=2.0),
    Case("cut for 15 s", NEAR, cut_s=15.0),
    Case("1 % lost, cut for 2 s, two routers", {**NEAR, "loss": 0.01}, cut_s=2.0, router=True),
    Case("desk asleep for 20 s", NEAR, asleep_s=20.0),
)


@dataclass(frozen=True)
class Outcome:
    """Of one run.

    Attributes:
        closed: the loop has.
        figures: what it was like.
        gone_mm: how far the robot moved while nobody could ask it to.
        told: the end of what the operator's command said.
    """

    closed: bool
    figures: Figures
    gone_mm: float
    told: str


def run(case: Case) -> Outcome:
    """Let a scripted operator teach over the network until the loop closes."""
    with Link() as link, tempfile.TemporaryDirectory() as folder:
        link.shape(**case.shape)
        with Sites(link, Path(folder), pictures=case.pictures, router=case.router) as sites:
            lost_ns = _trouble(case, link, sites)
            closed = sites.closes(RUN_S)
            record = Record(*sites.heard())
            gone = record.moved_between(*lost_ns) if lost_ns else 0.0
            return Outcome(closed, record.figures(), 1e3 * gone, sites.desk.tail())


def _trouble(case, link, sites):
    """Cut or sleep, as the case has it; from when to when nobody could ask for a motion, in the robot's clock [ns]."""
    if not (case.cut_s or case.asleep_s):
        return None
    sites.refining(CUT_AT)
    if case.cut_s:
        link.cut()
        began = time.clock_gettime_ns(time.CLOCK_BOOTTIME)
        time.sleep(case.cut_s)
        ended = time.clock_gettime_ns(time.CLOCK_BOOTTIME)
        link.restore()
    else:
        with sites.asleep():
            began = time.clock_gettime_ns(time.CLOCK_BOOTTIME)
            time.sleep(case.asleep_s)
            ended = time.clock_gettime_ns(time.CLOCK_BOOTTIME)
    return began + round(HELD_S * 1e9), ended
