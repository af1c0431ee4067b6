"""Zenoh by itself, with the least that makes messages of bytes: each is stamped, encoded and decoded, and that is all.

A program that uses Zenoh without the bus has to do as much: what it can use is a message, not bytes. It judges nothing:
no rules, no numbers, no freshness, no names that are compared.
"""

import contextlib
import itertools

import msgspec

from protocol import topics
from tests.bench.wire.carriers import bare_zenoh
from tests.bench.wire.command import MASTER, MOVED, ROBOT
from tests.bench.wire.program import now_ns

NAMED = msgspec.structs.replace(MOVED, robot=ROBOT, topic=topics.MASTER_STATE.name, process=MASTER, publisher=2**62)

routing = bare_zenoh.routing


@contextlib.contextmanager
def sending(settings, kind):
    """Sends messages of a kind; a command is encoded when it is sent."""
    encode, numbers = msgspec.msgpack.Encoder().encode, itertools.count(1)
    with bare_zenoh.sending(settings, kind) as put:
        if kind == "command":
            yield lambda _: put(encode(msgspec.structs.replace(NAMED, sequence=next(numbers), stamp_ns=now_ns())))
        else:
            yield put


@contextlib.contextmanager
def receiving(settings, notes):
    """Hands what comes to the notes, commands decoded."""
    decode = msgspec.msgpack.Decoder(topics.MASTER_STATE.type).decode

    def hear(sample):
        command = decode(sample.payload.to_bytes())
        came_ns = now_ns()
        notes.note(command.stamp_ns, came_ns)

    with bare_zenoh.subscribed(settings, hear, notes):
        yield
