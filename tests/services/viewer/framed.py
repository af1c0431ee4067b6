"""Files that are framed as recordings are, with messages of no meaning."""

import struct


def recording(path, messages):
    """A file of so many messages, each longer than the one before."""
    framed = (struct.pack("<QQ", 1, 20 * number) + bytes([number]) * 20 * number for number in range(1, messages + 1))
    path.write_bytes(b"RRF2" + bytes(8) + b"".join(framed))
    return path
