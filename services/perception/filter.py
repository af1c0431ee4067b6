"""The median over the last pictures of an object that stands still."""

from __future__ import annotations

from collections import deque

import numpy as np

from services.perception.placement import Matrix, assembled

_MOVED = 0.02  # [m] from the median: more than a picture's noise
_CONFIRMATIONS = 3  # pictures in a row that agree on the new place


class PoseFilter:
    """Filters the object's pose over pictures, and starts anew where the object has moved.

    A single picture that disagrees is an outlier; three in a row that agree with each other are a move.

    Args:
        window: over how many pictures the median is taken, at least 1.
    """

    def __init__(self, window: int) -> None:
        self._window: deque[Matrix] = deque(maxlen=window)
        self._moved: list[Matrix] = []

    def __len__(self) -> int:
        """How many pictures the pose rests on."""
        return len(self._window)

    def update(self, base_from_object: Matrix) -> Matrix | None:
        """Take in a picture's placement of the object; the filtered one, or None while it is not known.

        Args:
            base_from_object: shape (4, 4), in the base frame.
        """
        if self._window and _distance(base_from_object, _median(self._window)) > _MOVED:
            return self._disagree(base_from_object)
        self._moved.clear()
        self._window.append(base_from_object)
        return _median(self._window)

    def _disagree(self, base_from_object: Matrix) -> Matrix | None:
        if self._moved and _distance(base_from_object, self._moved[-1]) > _MOVED:
            self._moved.clear()
        self._moved.append(base_from_object)
        if len(self._moved) < min(_CONFIRMATIONS, self._window.maxlen or 1):
            return None
        # Only the newest: while an object is on its way, the earlier pictures show where it was.
        self._window.clear()
        self._window.append(base_from_object)
        self._moved.clear()
        return base_from_object


def _distance(first: Matrix, second: Matrix) -> float:
    return float(np.linalg.norm(first[:3, 3] - second[:3, 3]))


def _median(placements: deque[Matrix]) -> Matrix:
    """The median position, and the mean of the rotations: the rotation nearest to their average matrix."""
    stacked = np.array(placements)
    left, _, right = np.linalg.svd(stacked[:, :3, :3].mean(axis=0))
    left[:, 2] *= np.sign(np.linalg.det(left @ right))
    return assembled(left @ right, np.median(stacked[:, :3, 3], axis=0))
