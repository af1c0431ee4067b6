"""The protocol's failures.

ProtocolError
├── MalformedMessage   the bytes are not a message of the topic or query
├── OversizedMessage   more bytes than the registry allows
├── WrongVersion       a message of another schema version
├── Misplaced          a message, request or reply that belongs elsewhere
└── InvalidName        a name that cannot be a chunk of a key expression
"""


class ProtocolError(Exception):
    """Base of everything that this package raises."""


class MalformedMessage(ProtocolError):
    """The payload does not decode to the type that the registry names."""

    def __init__(self, subject: str, reason: str) -> None:
        self.subject = subject
        self.reason = reason
        super().__init__(f"malformed message on {subject}: {reason}")


class OversizedMessage(ProtocolError):
    """The payload is larger than the registry's bound."""

    def __init__(self, subject: str, size: int, bound: int) -> None:
        self.subject = subject
        self.size = size
        self.bound = bound
        super().__init__(f"message on {subject} has {size} bytes, at most {bound} are allowed")


class WrongVersion(ProtocolError):
    """The sender announced another schema than the one that the registry names."""

    def __init__(self, subject: str, announced: str, expected: str) -> None:
        self.subject = subject
        self.announced = announced
        self.expected = expected
        super().__init__(f"message on {subject} announces {announced}, this version reads {expected}")


class Misplaced(ProtocolError):
    """It came where it does not belong, or from a process that has no business there."""

    def __init__(self, subject: str, reason: str) -> None:
        self.subject = subject
        self.reason = reason
        super().__init__(f"misplaced on {subject}: {reason}")


class InvalidName(ProtocolError):
    """A robot's or a process' name that cannot stand in a key expression."""

    def __init__(self, name: str) -> None:
        self.name = name
        super().__init__(
            f"the name {name!r} cannot stand in a key: up to 64 letters, digits, '-', '_', a letter or digit first"
        )
