"""Sound messages and requests with whatever their types allow: the least, the greatest, the longest, the oddest."""

import enum
import types
import typing

import msgspec
import numpy as np

from protocol.messages import Array, Motion, Pose

TEXTS = ("", "\0", "\x1b[2J\n", "../..", "robot", "🤖", "'; --", "<b>", "nan")
REALS = (0.0, -0.0, 1e-300, 1e-3, -0.05, 0.5, 1.0, 9.99, 1e3)
ORIENTATIONS = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (-0.5, 0.5, -0.5, 0.5), (0.9995, 0.0, 0.0, 0.0))
SHAPES = ((), (0,), (1,), (3,), (7,), (2, 3), (0, 3), (5, 3), (75, 3), (2, 2, 2))
POINTS = (2, 3, 75, 1000, 1001)

REGIONS = {
    "object_region": (((-1e9, -1e9, -1e9), (1e9, 1e9, 1e9)), ((0.8, 0.0, 0.5), (0.8, 0.1, 0.5))),
    "condition_region": (((), ()), ((-0.1, -0.1), (0.1, 0.1)), ((-1e9,) * 64, (1e9,) * 64)),
}
"""By chance hardly any two corners are a region."""


class Extremes:
    """Makes values of any type of the protocol.

    Args:
        rng: that decides.
        known: values that fields of a name often have, so that some of what is made is taken seriously.
    """

    def __init__(self, rng, known=None):
        self._rng = rng
        self._known = known or {}

    def struct(self, type_):
        """A message or a request."""
        hints = typing.get_type_hints(type_, include_extras=True)
        while True:
            try:
                return type_(**{name: self._field(name, hints[name]) for name in type_.__struct_fields__})
            except ValueError:  # its fields do not fit each other
                continue

    def _field(self, name, type_):
        if name in REGIONS:
            return self._rng.choice(REGIONS[name])
        if name in self._known and self._rng.random() < 0.7:
            return self._rng.choice(self._known[name])
        return self._value(type_)

    def _value(self, type_, meta=None):
        rng, origin, arguments = self._rng, typing.get_origin(type_), typing.get_args(type_)
        if origin is typing.Annotated:
            return self._value(arguments[0], arguments[1])
        if origin is typing.Union or origin is types.UnionType:
            chosen = rng.choice(arguments)
            return None if chosen is types.NoneType else self._value(chosen)
        if origin is tuple:
            return self._items(arguments, meta)
        return self._plain(type_, meta)

    def _items(self, arguments, meta):
        if arguments[-1] is not Ellipsis:
            return tuple(self._value(argument) for argument in arguments)
        longest = meta.max_length if meta is not None else 8
        length = self._rng.choice((0, 1, 2, 7, min(30, longest), longest))
        return tuple(self._value(arguments[0]) for _ in range(min(length, longest)))

    def _plain(self, type_, meta):
        made = {float: self._real, int: self._count, str: self._text}
        odd = {bool: self._flag, bytes: self._bytes, Array: self._array, Pose: self._pose, Motion: self._motion}
        if type_ in made:
            return made[type_](meta)
        if type_ in odd:
            return odd[type_]()
        return self._rng.choice(list(type_)) if issubclass(type_, enum.Enum) else self.struct(type_)

    def _real(self, meta):
        low = meta.ge if meta.ge is not None else meta.gt
        fitting = [real for real in (low, *REALS, meta.le) if low <= real <= meta.le and real != meta.gt]
        return self._rng.choice([*fitting, self._rng.uniform(low, meta.le)])

    def _count(self, meta):
        return self._rng.choice((meta.ge, meta.ge + 1, meta.le - 1, meta.le, self._rng.randint(0, 20)))

    def _text(self, meta):
        return self._rng.choice((*TEXTS, "x" * meta.max_length, "🤖" * meta.max_length))

    def _flag(self):
        return self._rng.random() < 0.5

    def _bytes(self):
        return self._rng.choice((b"", b"\xff\xd8\xff", self._rng.randbytes(100)))

    def _pose(self):
        position = tuple(self._rng.choice((-1e9, 1e9, *REALS)) for _ in range(3))
        return Pose(position, self._rng.choice(ORIENTATIONS))

    def _motion(self):
        n = self._rng.choice(POINTS)
        return Motion(self._array((n, 3)), self._array((n, 4)), self._rng.choice((1e-3, 0.5, 1.0, 3600.0)))

    def _array(self, shape=None):
        rng = self._rng
        shape = rng.choice(SHAPES) if shape is None else shape
        values = np.full(shape, rng.choice((0.0, 0.5, 1.0, 1e300, -1e9, float("nan"), float("inf"))))
        if rng.random() < 0.3:
            values = np.linspace(-0.5, 0.5, values.size).reshape(shape)
        return Array("<f8", shape, values.astype("<f8").tobytes())


def encoded(struct):
    """As any program could send it."""
    return msgspec.msgpack.encode(struct)
