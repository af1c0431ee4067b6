"""Files of lines of which each is chained to all that came before: what was written stays as it was, or it is seen.

A line is JSON: `{"chain": C, "entry": E}`. E is the entry as it was written, byte for byte, and C the SHA-256 digest of
the line's predecessor's digest and E, in hexadecimal, so that whoever knows the newest digest knows every line
(S. Haber, W. S. Stornetta, How to time-stamp a digital document, J. Cryptology 3, 1991, section 5.1).
"""

from __future__ import annotations

import hashlib

import msgspec

ORIGIN = "0" * 64
"""The digest before the first line."""


class Line(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """An entry as it lies in the file."""

    chain: str
    entry: msgspec.Raw

    def follows(self, chain: str) -> bool:
        """Whether it was written after the line of this digest, and is as it was written."""
        return self.chain == digest(chain, bytes(self.entry))


def digest(chain: str, entry: bytes) -> str:
    """Of a line, from its predecessor's digest and its entry."""
    return hashlib.sha256(chain.encode() + entry).hexdigest()


def sealed(entry: msgspec.Struct, chain: str) -> tuple[bytes, str]:
    """A line with its end, and its digest, after the line of the digest `chain`."""
    raw = msgspec.json.encode(entry)
    after = digest(chain, raw)
    return msgspec.json.encode(Line(after, msgspec.Raw(raw))) + b"\n", after
