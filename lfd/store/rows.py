"""A stored demonstration as rows of its file: numbers and texts, and arrays as bytes that nothing could execute."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from lfd.arrays import Array
from lfd.motion.demonstration import Demonstration
from lfd.motion.departure import Departure
from lfd.motion.provenance import Method, Provenance
from lfd.motion.trajectory import Trajectory
from lfd.store.schema import DTYPE
from lfd.store.stored import Binding, Purpose, StoredDemonstration, Turn

COLUMNS = (
    "added, kind, scene, robot, duration, author, at_s, confidence, method, part_first, part_last,"
    " departure_mean, departure_most"
)
"""Of the table of demonstrations, as `row_of` and `stored_in` order them."""


def row_of(
    version: int, demonstration: Demonstration, purpose: Purpose, binding: Binding, departure: Departure | None
) -> tuple[object, ...]:
    """The row of a demonstration that makes a version."""
    whose = demonstration.provenance
    return (
        *(version, purpose.value, *binding, demonstration.trajectory.duration),
        *(whose.author, whose.at_s, whose.confidence, whose.method.value),
        *(*demonstration.part, *(departure or (None, None))),
    )


def arrays_of(demonstration: Demonstration) -> Iterator[tuple[object, ...]]:
    """The rows of a demonstration's arrays: name, number format, shape and bytes."""
    arrays = {
        "positions": demonstration.trajectory.positions,
        "orientations": demonstration.trajectory.orientations,
        "origin": demonstration.origin,
        "condition": demonstration.condition,
    }
    if demonstration.trajectory.opening is not None:
        arrays["opening"] = demonstration.trajectory.opening
    for name, array in arrays.items():
        yield name, DTYPE, ",".join(map(str, array.shape)), array.astype(DTYPE).tobytes()


def stored_in(row: Sequence[Any], arrays: Sequence[tuple[Any, ...]], turn: Turn) -> StoredDemonstration:
    """The demonstration in rows.

    Args:
        row: Its columns.
        arrays: Name, number format, shape and bytes of each.
        turn: Whether it is in use.

    Raises:
        LfdError, ValueError, KeyError: They are damaged.
    """
    added, purpose, scene, robot, duration, author, at_s, confidence, method, first, last, mean, most = row
    found = {name: _array(*parts) for name, *parts in arrays}
    given = Demonstration(
        Trajectory(found["positions"], found["orientations"], duration, found.get("opening")),
        found["origin"],
        found["condition"],
        Provenance(author, at_s, confidence, Method(method)),
        (first, last),
    )
    departure = None if mean is None else Departure(mean, most)
    return StoredDemonstration(added, Purpose(purpose), Binding(scene, robot), given, departure, turn)


def _array(dtype: str, shape: str, data: bytes) -> Array:
    if dtype != DTYPE:
        raise ValueError(f"unknown number format {dtype!r}")
    return np.frombuffer(data, dtype=DTYPE).reshape([int(length) for length in shape.split(",")])
