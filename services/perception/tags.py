"""Finds the object's fiducial marker in a picture and says where the object is.

A square seen by one camera has two poses that explain it almost equally well, mirror images of each other about the
line of sight (Collins and Bartoli 2014). Where the picture does not tell them apart, the one counts that agrees with
the pose before, and at first the one in which the object stands upright.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from services.perception.placement import Matrix, angle_between, assembled, inverse, placement
from sim.region import Region
from sim.tasks.thing import Tag, Thing

Picture = NDArray[np.uint8]
Corners = NDArray[np.float64]

# In the marker's frame: x right, y up, z out of the print; clockwise from the upper left, as solvePnP wants them.
_SQUARE = np.array([[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, -1.0, 0.0]])

_USUAL = Thing("object", (0.05, 0.05, 0.10), 0.15, Region((0.0,) * 3, (0.0,) * 3), tag=Tag())

_ENLARGEMENT = 3
_MARGIN = 4.0  # [pixel] beside half the marker's size

_FARTHEST = 100.0  # [m] no robot reaches an object there, and no camera sees its marker

# A pose explains the corners where its error is within this ratio of the best one's, or within the corners' noise.
_AMBIGUOUS_RATIO = 2.0
_CORNER_NOISE = 0.4  # [pixel]


@dataclass(frozen=True, eq=False)
class Tagged:
    """What is looked for.

    Attributes:
        tag: on the object.
        square: the marker's corners in its own frame, shape (4, 3) [m].
        tag_from_object: placement of the object in the marker's frame.
    """

    tag: Tag
    square: NDArray[np.float64]
    tag_from_object: Matrix

    @classmethod
    def of(cls, thing: Thing | None) -> Tagged:
        """An object with its marker; the usual one where none is known."""
        thing = thing or _USUAL
        tag, pose = thing.tag or Tag(), thing.tag_pose
        return cls(tag, tag.size / 2 * _SQUARE, inverse(placement(pose.position, pose.orientation)))


@dataclass(frozen=True, eq=False)
class Candidate:
    """One of the poses that explain the corners.

    Attributes:
        base_from_object: placement of the object in the base frame.
        error: root mean square of the reprojection [pixel].
    """

    base_from_object: Matrix
    error: float


@dataclass(frozen=True, eq=False)
class Choice:
    """The pose that counts.

    Attributes:
        base_from_object: placement of the object in the base frame.
        flipped: another pose explained the corners better and was rejected.
    """

    base_from_object: Matrix
    flipped: bool


def decode(data: bytes) -> Picture | None:
    """The grey picture, shape (height, width), in a JPEG file; None where the bytes are no picture."""
    if not data:
        return None
    try:
        picture = cv2.imdecode(np.frombuffer(data, dtype=np.uint8), cv2.IMREAD_GRAYSCALE)
    except cv2.error:
        return None
    return None if picture is None else np.asarray(picture, dtype=np.uint8)


class TagFinder:
    """Finds the corners of the object's marker: where it is in the picture, then its edges in the enlarged cut-out.

    The refinement along the edges (AprilTag's) has no bias in depth, where those at the corners have several
    millimetres. It is slow on whole pictures, and misses markers of less than 25 pixels unless they are enlarged.

    Args:
        tag: that is looked for.
    """

    def __init__(self, tag: Tag) -> None:
        self._id = tag.id
        self._coarse = _detector(tag.dictionary, cv2.aruco.CORNER_REFINE_NONE)
        self._fine = _detector(tag.dictionary, cv2.aruco.CORNER_REFINE_APRILTAG)

    def find(self, picture: Picture) -> Corners | None:
        """The marker's corners, shape (4, 2) [pixel], clockwise from its upper left; None where it is not seen.

        The centres of the pixels are at whole numbers.

        Args:
            picture: grey, shape (height, width).
        """
        rough = _corners(self._coarse, picture, self._id)
        if rough is None:
            return None
        margin = _MARGIN + np.ptp(rough, axis=0).max() / 2
        left, top = np.maximum(np.floor(rough.min(axis=0) - margin), 0).astype(int)
        right, bottom = np.ceil(rough.max(axis=0) + margin).astype(int)
        cut = picture[top:bottom, left:right]
        enlarged = cv2.resize(cut, None, fx=_ENLARGEMENT, fy=_ENLARGEMENT, interpolation=cv2.INTER_CUBIC)
        refined = _corners(self._fine, np.asarray(enlarged, dtype=np.uint8), self._id)
        if refined is None:
            return None
        # This refinement counts from the outer edge of the first pixel.
        located: Corners = refined / _ENLARGEMENT - 0.5 + (left, top)
        return located


def _detector(family: str, refinement: int) -> cv2.aruco.ArucoDetector:
    parameters = cv2.aruco.DetectorParameters()
    parameters.cornerRefinementMethod = refinement
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, family))
    return cv2.aruco.ArucoDetector(dictionary, parameters)


def _corners(detector: cv2.aruco.ArucoDetector, picture: Picture, wanted: int) -> Corners | None:
    quadrangles, identities, _ = detector.detectMarkers(picture)
    if identities is None:
        return None
    for corners, identity in zip(quadrangles, np.asarray(identities).ravel(), strict=True):
        if identity == wanted:
            return np.asarray(corners, dtype=np.float64).reshape(4, 2)
    return None


def candidates(
    corners: Corners,
    intrinsics: tuple[float, float, float, float],
    base_from_camera: Matrix,
    tagged: Tagged,
) -> list[Candidate]:
    """The poses of the object that explain the marker's corners, the best first.

    Args:
        corners: shape (4, 2) [pixel], the pixels' centres at whole numbers.
        intrinsics: fx, fy, cx, cy [pixel].
        base_from_camera: placement of the optical frame (x right, y down, z forward) in the base frame.
        tagged: whose corners they are.
    """
    fx, fy, cx, cy = intrinsics
    matrix = np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])
    try:
        _, rotations, translations, errors = cv2.solvePnPGeneric(
            tagged.square, corners, matrix, None, flags=cv2.SOLVEPNP_IPPE_SQUARE
        )
    except cv2.error:  # a camera that there cannot be
        return []
    found = []
    # For such a camera there may also be more errors than poses.
    for rotation, translation, error in zip(rotations, translations, np.ravel(errors), strict=False):
        camera_from_tag = assembled(np.asarray(cv2.Rodrigues(rotation)[0], dtype=np.float64), translation)
        base_from_object = base_from_camera @ camera_from_tag @ tagged.tag_from_object
        # What is not a number is not near either.
        if np.isfinite(error) and np.all(np.abs(base_from_object) <= _FARTHEST):
            found.append(Candidate(base_from_object, float(error)))
    return sorted(found, key=lambda candidate: candidate.error)


def choose(found: Sequence[Candidate], previous: Matrix | None) -> Choice | None:
    """The candidate that counts; None where there is none.

    Args:
        found: the best first.
        previous: placement of the object in the base frame a moment ago; None at first.
    """
    if not found:
        return None
    best = found[0]
    limit = max(_AMBIGUOUS_RATIO * best.error, _CORNER_NOISE)
    plausible = [candidate for candidate in found if candidate.error <= limit]
    if previous is None:
        chosen = max(plausible, key=lambda candidate: float(candidate.base_from_object[2, 2]), default=best)
    else:
        chosen = min(plausible, key=lambda c: angle_between(c.base_from_object, previous), default=best)
    return Choice(chosen.base_from_object, flipped=chosen is not best)
