"""How values of some kind become an entity's columns, many at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, TypeVar

import numpy as np
import rerun as rr

from protocol.messages import Pose, Vector3

V_contra = TypeVar("V_contra", contravariant=True)


class Kind(Protocol[V_contra]):
    """A kind of value."""

    @property
    def rows(self) -> int:
        """That each value takes."""
        ...

    def columns(self, values: Sequence[V_contra]) -> list[rr.ComponentColumn]:
        """The columns of these values, in order."""
        ...


class _Scalars:
    """Numbers, one for each line of a plot."""

    rows = 1

    def columns(self, values: Sequence[Sequence[float]]) -> list[rr.ComponentColumn]:
        lengths = [len(numbers) for numbers in values]
        return list(rr.Scalars.columns(scalars=np.concatenate(values)).partition(lengths))


class _Words:
    """What holds from now on, in a word or two; nothing where it is empty."""

    rows = 1

    def columns(self, values: Sequence[str]) -> list[rr.ComponentColumn]:
        return list(rr.StateChange.columns(state=values))


class _Poses:
    """Where something is in its parent's frame."""

    rows = 1

    def columns(self, values: Sequence[Pose]) -> list[rr.ComponentColumn]:
        positions = np.array([pose.position for pose in values])
        orientations = np.array([pose.orientation for pose in values])
        # Rerun has the scalar last.
        return list(rr.Transform3D.columns(translation=positions, quaternion=np.roll(orientations, -1, axis=1)))


class _Arrows:
    """An arrow from a point, each shape (3,) [m], or none."""

    rows = 1

    def columns(self, values: Sequence[tuple[Vector3, Vector3] | None]) -> list[rr.ComponentColumn]:
        drawn = np.array([arrow for arrow in values if arrow is not None]).reshape(-1, 2, 3)
        lengths = [int(arrow is not None) for arrow in values]
        return list(rr.Arrows3D.columns(origins=drawn[:, 0], vectors=drawn[:, 1]).partition(lengths))


SCALARS: Kind[Sequence[float]] = _Scalars()
WORDS: Kind[str] = _Words()
POSES: Kind[Pose] = _Poses()
ARROWS: Kind[tuple[Vector3, Vector3] | None] = _Arrows()
"""Where it begins, and where it leads from there."""
