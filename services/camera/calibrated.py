"""What was measured of a camera, in the place of what is only said of it."""

from __future__ import annotations

from typing import NamedTuple

from services.camera.optics import Optics
from services.camera.places import Mounting
from services.process.calibration import load_calibration
from services.process.exceptions import FolderUnusable


class Calibrated(NamedTuple):
    """Of one camera.

    Attributes:
        optics: how it sees; None where that was not measured.
        mounting: where it is fixed; the same.
    """

    optics: Optics | None = None
    mounting: Mounting | None = None


def calibrated(robot: str, camera: str) -> Calibrated:
    """What was measured of a camera of a robot; where this user has no folder for it, nothing was.

    Raises:
        ConfigurationError: the file cannot be used; says why.
    """
    try:
        found = load_calibration(robot, camera)
    except FolderUnusable:
        return Calibrated()
    if found is None:
        return Calibrated()
    optics = Optics(found.width, found.height, found.focal, found.centre, found.distortion)
    fixed = found.fixed
    return Calibrated(optics, None if fixed is None else Mounting(fixed.link, fixed.position, fixed.orientation))
