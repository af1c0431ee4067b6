"""The same way as pictures travel it: how much comes through, and whether that is enough for two cameras."""

from __future__ import annotations

import threading
from collections.abc import Iterator

from protocol.messages import Probe
from protocol.topics import LOAD
from services.commands.doctor.case import Case
from services.commands.doctor.finding import Finding, look, ok, wrong
from services.commands.doctor.load import Load

PICTURES = "pictures"

CHUNK_BYTES = 4096
MOST_BYTES = 4_000_000
WITHIN_NS = 2_000_000_000
WAIT_S = 0.05

TWO_CAMERAS = 3e6 / 8
"""What the two cameras of the default configuration send: 15 times a second some 12 kB each [byte/s]."""

ENOUGH = 8.0 * TWO_CAMERAS

LEAST = TWO_CAMERAS * 0.04
"""What they send at the least; see `services.camera.pacing`."""


def check_pictures(case: Case) -> Iterator[Finding]:
    """Load the way a little, and judge what came through."""
    yield judged(_loaded(case))


def _loaded(case: Case) -> Load | None:
    """None where nothing comes back at all."""
    assert case.speaker is not None
    assert case.hearer is not None
    call = threading.Event()
    heard = case.hearer.subscribe(LOAD, call)
    own, padding = case.speaker.identity, bytes(CHUNK_BYTES)
    if not case.comes_back(LOAD, heard):  # over a network pictures have a link of their own
        return None
    load = Load(CHUNK_BYTES, MOST_BYTES, ENOUGH, WITHIN_NS, case.clock.now_ns())
    while not load.ended:
        call.clear()
        came = [
            (one.message.number - 1, one.received_ns)
            for one in heard.take()
            if one.message.publisher == own and one.message.number  # not what only asked whether there is a way
        ]
        for number in load.step(case.clock.now_ns(), came):
            case.speaker.publish(LOAD, Probe(number=number + 1, padding=padding))
        call.wait(WAIT_S)
        case.wait(0.0)
    return load


def judged(load: Load | None) -> Finding:
    """Whether two cameras have room."""
    if load is None or load.rate < LEAST:
        told = (
            f"{load.rate * 8e-6:.2f} Mbit/s come through" if load is not None and load.rate else "nothing comes through"
        )
        return wrong(PICTURES, told, f"even the smallest pictures take {LEAST * 8e-6:.2f}: another way, less traffic")
    more = load.grew and not load.lost
    told = f"{'more than ' if more else ''}{load.rate * 8e-6:.1f} Mbit/s come through, to the router and back"
    if load.rate < TWO_CAMERAS and more:
        return look(PICTURES, f"{told}; over so long a way two seconds do not show how much more")
    if load.rate < TWO_CAMERAS:
        return look(
            PICTURES, told, f"two cameras send {TWO_CAMERAS * 8e-6:.0f}: they will send fewer, coarser pictures"
        )
    return ok(PICTURES, f"{told}: enough for two cameras, which send {TWO_CAMERAS * 8e-6:.0f}")
