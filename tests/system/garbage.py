"""What a network can throw at a process: made from real messages, by what is wrong with them."""

import random
import secrets

import msgpack
import msgspec
import numpy as np

from protocol import topics
from protocol.messages import Array
from services.bus.identity import boot_identity
from services.process.clock import SystemClock

HOUR_NS = 3_600_000_000_000
NESTED = 100_000
ANOTHER_VERSION = "Nonsense/9"

REPEATS = 10
LARGE_REPEATS = 2


def by_cause(topic, sample, rng):
    """Cause to payloads that have to be dropped for it."""
    repeats = LARGE_REPEATS if topic.max_bytes > 100_000 else REPEATS
    now_ns = SystemClock().now_ns()
    return {
        "malformed": [
            *no_messages(topic.max_bytes),
            *malformed(sample, rng, repeats),
            *(fuzz(rng, topic.max_bytes) for _ in range(5 * repeats)),
        ],
        "oversized": oversized(topic.max_bytes, repeats),
        "wrong_version": [sample] * repeats,
        # A stop is a stop whatever its stamp and however often it comes, and no message is too late to be an event.
        "future": from_the_future(sample, now_ns, repeats) if topic is not topics.EMERGENCY_STOP else [],
        "repeated": [sample] * repeats if topic is not topics.EMERGENCY_STOP else [],
        "stale": from_the_past(sample, now_ns, repeats) if topic.stale_after_ns is not None else [],
    }


def no_messages(bound: int) -> list[bytes]:
    """Bytes that are no message of any topic, and no request, none longer than the bound."""
    return [
        b"",
        b"\xc1",
        msgpack.packb(None),
        msgpack.packb(7),
        msgpack.packb("text"),
        msgpack.packb([1, 2, 3]),
        msgpack.packb({1: 2}) + b"trailing",
        b"\x91" * min(bound, NESTED),
        b"\xdf\xff\xff\xff\xff",  # a map of four thousand million entries
        b"\xdd\xff\xff\xff\xff",  # a list of as many
        b"\xc6\xff\xff\xff\xff",  # bytes of as many
    ]


def fuzz(rng: random.Random, bound: int) -> bytes:
    """Bytes at random, never a map."""
    return b"\x93" + rng.randbytes(rng.randrange(min(bound, 4096)))


def malformed(sample: bytes, rng: random.Random, count: int) -> list[bytes]:
    """Messages that do not decode: truncated, of wrong types, with numbers that are none."""
    fields = msgpack.unpackb(sample, strict_map_key=False)
    wrong = [sample[: rng.randrange(len(sample))] for _ in range(count)]
    # A map could be a sound message's part whose fields all have defaults; an extension is nothing that is spoken here.
    wrong += [msgpack.packb({**fields, name: msgpack.ExtType(7, b"wrong type")}) for name in fields]
    wrong += [msgpack.packb({**fields, "sequence": value}) for value in (-1, 1.5, "1", None, 2**60)]
    for number in (float("nan"), float("inf"), -float("inf"), 1e300):
        poisoned = _with_reals(fields, number)
        if poisoned != fields:
            wrong.append(msgpack.packb(poisoned))
    return wrong


def oversized(bound: int, count: int) -> list[bytes]:
    """A byte more than allowed."""
    return [b"\0" * (bound + 1)] * count


def from_the_future(sample: bytes, now_ns: int, count: int) -> list[bytes]:
    """Sound messages of senders on this machine whose clock would be an hour ahead."""
    return [_sent(sample, now_ns + HOUR_NS) for _ in range(count)]


def from_the_past(sample: bytes, now_ns: int, count: int) -> list[bytes]:
    """Sound messages that took an hour, of new senders on this machine and of the real one, counted far ahead."""
    fields = msgpack.unpackb(sample, strict_map_key=False)
    stamp_ns = max(0, now_ns - HOUR_NS)
    ahead = msgpack.packb({**fields, "sequence": 2**53, "stamp_ns": stamp_ns})
    return [ahead, *(_sent(sample, stamp_ns) for _ in range(count - 1))]


def _sent(sample: bytes, stamp_ns: int) -> bytes:
    publisher = boot_identity() << 47 | secrets.randbits(47)
    fields = msgpack.unpackb(sample, strict_map_key=False)
    return msgpack.packb({**fields, "publisher": publisher, "sequence": 1, "stamp_ns": stamp_ns})


def _with_reals(value, number):
    """The value with all its real numbers replaced."""
    match value:
        case float():
            return number
        case dict():
            return {key: _with_reals(inner, number) for key, inner in value.items()}
        case list():
            return [_with_reals(inner, number) for inner in value]
        case _:
            return value


def nonsense(*shape):
    """An array that the codec lets pass and that holds no number."""
    return Array("<f8", shape, np.full(shape, np.nan).tobytes())


def hollow(motion):
    """A motion that holds no number."""
    return msgspec.structs.replace(motion, positions=nonsense(*motion.positions.shape))
