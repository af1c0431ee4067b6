"""Messages as a faulty or hostile sender changes them."""

MARKS = bytes(range(0xC0, 0xE0)) + b"\x00\x7f\x80\x8f\x90\x9f\xa0\xbf\xff"
"""First bytes of what msgpack can hold: nil, floats, strings, arrays, maps, extensions, of every length's form."""


def mutated(rng, sound, others):
    """Bytes that somebody has flipped, cut, repeated, filled up, or put together from two messages."""
    payload = bytearray(sound)
    for _ in range(1 + rng.getrandbits(2)):
        at = rng.randrange(len(payload) or 1)
        match rng.getrandbits(3):
            case 0 if payload:
                payload[at] ^= 1 << rng.getrandbits(3)
            case 1 if payload:
                payload[at] = rng.choice(MARKS)
            case 2:
                del payload[at : at + 1 + rng.getrandbits(3)]
            case 3:
                payload[at:at] = rng.randbytes(1 + rng.getrandbits(3))
            case 4:
                other = rng.choice(others)
                payload[at:] = other[rng.randrange(len(other)) :]
            case 5:
                payload[at:at] = payload[at : at + rng.getrandbits(6)]
            case 6:
                payload[at : at + 4] = rng.choice((b"\xff\xff\xff\xff", b"\x7f\xff\xff\xff", b"\x00\x00\x00\x00"))
            case _:
                del payload[at:]
    return bytes(payload)
