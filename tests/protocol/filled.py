"""One example of every message and request, made from the types themselves."""

import enum
import types
import typing

import msgspec

from protocol.messages import Array, Motion, Part, Pose, Way, Waypoint

EXAMPLES = {
    Pose: Pose((0.1, 0.2, 0.3), (1.0, 0.0, 0.0, 0.0)),
    Waypoint: Waypoint((0.1, 0.2, 0.3), (1.0, 0.0, 0.0, 0.0), 0.05),
    Array: Array("<f8", (1, 2), b"\0" * 16),
    Motion: Motion(Array("<f8", (2, 3), b"\0" * 48), Array("<f8", (2, 4), b"\0" * 64), 1.0),
    Part: Part(0.25, 0.75),
    Way: Way(1, 2, 0.75),
    bool: True,
    int: 7,
    float: 0.5,
    str: "x",
    bytes: b"\x01",
}
"""Of plain types, and of those whose fields have to fit each other."""


def example(type_):
    """A valid value of a field's type."""
    origin, arguments = typing.get_origin(type_), typing.get_args(type_)
    if origin is typing.Annotated:
        return _bounded(arguments)
    if origin is typing.Union or origin is types.UnionType:
        return example(next(a for a in arguments if a is not type(None)))
    if origin is tuple:
        return tuple(example(a) for a in arguments if a is not Ellipsis)
    if type_ in EXAMPLES:
        return EXAMPLES[type_]
    return next(iter(type_)) if issubclass(type_, enum.Enum) else filled(type_)


def _bounded(arguments):
    if arguments[0] is float and any(isinstance(m, msgspec.Meta) and m.gt == 0.0 for m in arguments[1:]):
        return 1.0
    return example(arguments[0])


def filled(type_):
    """A struct with every field set."""
    hints = typing.get_type_hints(type_, include_extras=True)
    return type_(**{field: example(hints[field]) for field in type_.__struct_fields__})
