"""Who a sender is: its machine since boot in the upper bits, the process' incarnation in the lower ones."""

import secrets
import zlib
from pathlib import Path

_LOW_BITS = 47


def boot_identity() -> int:
    """15 bits that are equal for all processes of a machine until it is started anew, so that clocks compare."""
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_bytes()
    except OSError:
        boot = secrets.token_bytes(16)
    return zlib.crc32(boot) & 0x7FFF


def new_publisher() -> int:
    """An identity that no other process, and no earlier incarnation of this one, has."""
    return boot_identity() << _LOW_BITS | secrets.randbits(_LOW_BITS)


def new_number() -> int:
    """A number that nobody else comes upon, in this run or another, and never 0; 53 bits, as a message counts."""
    return secrets.randbits(53) or 1


def machine(publisher: int) -> int:
    """The number of the publisher's machine since its boot."""
    return publisher >> _LOW_BITS


def same_clock(publisher: int, other: int) -> bool:
    """Whether the stamps of two publishers come from the same clock."""
    return machine(publisher) == machine(other)
