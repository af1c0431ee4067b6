"""Numbers over time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import astuple

import numpy as np
import rerun as rr

from protocol.messages import MasterState, Pose, Vector3
from services.bus.stages import NAMES, Stages
from services.viewer import entities, palette
from services.viewer.kinds import SCALARS
from services.viewer.run import Run

_AXES = ("x", "y", "z")
_WIDTH = 1.5

_LEGENDS = {
    entities.MASTER_DISPLACEMENT: [f"{axis} [mm]" for axis in _AXES],
    entities.MASTER_ROTATION: [f"about {axis} [deg]" for axis in _AXES],
    entities.MASTER_FORCE: [f"{axis} [N]" for axis in _AXES],
    entities.CORRECTION_OFFSET: [f"{axis} [mm]" for axis in _AXES],
    entities.CORRECTION_TURN: [f"about {axis} [deg]" for axis in _AXES],
    entities.COMMANDED: [f"commanded {axis} [m]" for axis in _AXES],
    entities.MEASURED: [f"measured {axis} [m]" for axis in _AXES],
    entities.POSITION_ERROR: [f"{axis} [mm]" for axis in _AXES],
    entities.ORIENTATION_ERROR: ["angle [deg]"],
    entities.OBJECT_ERROR: ["distance [mm]"],
    entities.SELF_DISTANCE: ["distance [mm]"],
    entities.OPENING: ["told [mm]", "measured [mm]"],
    entities.LATENCY: ["operator to robot [ms]"],
}

_COLOURS = {
    entities.COMMANDED: palette.AXES_PALE,
    entities.ORIENTATION_ERROR: palette.MANY,
    entities.OBJECT_ERROR: palette.MANY,
    entities.SELF_DISTANCE: palette.MANY,
    entities.OPENING: palette.MANY,
    entities.LATENCY: palette.MANY,
}
"""Where they are not those of the axes."""


def log_legends(run: Run) -> None:
    """Name and colour what has a fixed number of lines."""
    for path, names in _LEGENDS.items():
        _log_legend(run, path, names, _COLOURS.get(path, palette.AXES))
    for number, name in enumerate(NAMES):
        _log_legend(run, f"{entities.STAGES}/{name}", [f"{name} [ms]"], palette.MANY[number:])


def log_joint_legend(run: Run, names: Sequence[str]) -> None:
    """Name and colour the joints."""
    _log_legend(run, entities.JOINTS, [name.removesuffix("_joint") for name in names], palette.MANY)


def log_joints(run: Run, q: Sequence[float]) -> None:
    """Joint positions [rad, torso m]."""
    if q:
        run.row(entities.JOINTS, SCALARS, q)


def log_opening(run: Run, told: float, measured: float) -> None:
    """How far the gripper is open [m]; nothing of a robot without one."""
    if told or measured:
        run.row(entities.OPENING, SCALARS, _milli([told, measured]))


def log_axes(run: Run, controller: str, axes: Sequence[float]) -> None:
    """A controller's axes as they are read; nothing where it has none."""
    if axes:
        run.row(f"{entities.INPUT}/{controller}", SCALARS, axes)


def log_axes_legend(run: Run, controller: str, count: int) -> None:
    """Name and colour as many axes of a controller."""
    names = [f"{controller} axis {number}" for number in range(count)]
    _log_legend(run, f"{entities.INPUT}/{controller}", names, palette.MANY)


def log_master(run: Run, master: MasterState) -> None:
    """What the hand does with the device, and the force that it feels, in base axes."""
    run.row(entities.MASTER_DISPLACEMENT, SCALARS, _milli(master.displacement))
    run.row(entities.MASTER_ROTATION, SCALARS, _degrees(master.rotation))
    run.row(entities.MASTER_FORCE, SCALARS, master.force)


def log_correction(run: Run, offset: Vector3, turn: Vector3) -> None:
    """The correction as the robot applies it, in base axes: offset [m] and rotation vector [rad]."""
    run.row(entities.CORRECTION_OFFSET, SCALARS, _milli(offset))
    run.row(entities.CORRECTION_TURN, SCALARS, _degrees(turn))


def log_following(run: Run, commanded: Pose, measured: Pose) -> None:
    """Where the grasping frame was told to be, where it is, and by how much it is off, measured less commanded."""
    run.row(entities.COMMANDED, SCALARS, commanded.position)
    run.row(entities.MEASURED, SCALARS, measured.position)
    pairs = zip(measured.position, commanded.position, strict=True)
    run.row(entities.POSITION_ERROR, SCALARS, _milli([is_ - told for is_, told in pairs]))
    run.row(entities.ORIENTATION_ERROR, SCALARS, [math.degrees(_angle(commanded, measured))])


def log_object_error(run: Run, error: float) -> None:
    """Distance of the object as seen from where it is [m]; negative where it is not known."""
    if error >= 0.0:
        run.row(entities.OBJECT_ERROR, SCALARS, _milli([error]))


def log_self_distance(run: Run, distance: float) -> None:
    """The least distance between parts of the robot [m]."""
    run.row(entities.SELF_DISTANCE, SCALARS, _milli([distance]))


def log_latency(run: Run, latency_s: float) -> None:
    """From the operator's sample to its effect [s]; negative where it is not known."""
    if latency_s >= 0.0:
        run.row(entities.LATENCY, SCALARS, _milli([latency_s]))


def log_stages(run: Run, known: Stages) -> None:
    """Each stage between hand and eye that is known."""
    for name, value_s in zip(NAMES, astuple(known), strict=True):
        if value_s is not None:
            run.row(f"{entities.STAGES}/{name}", SCALARS, _milli([value_s]))


def _log_legend(run: Run, path: str, names: Sequence[str], colours: palette.Colours) -> None:
    line = rr.SeriesLines(names=names, colors=np.resize(colours, len(names)), widths=[_WIDTH])
    run.log_always(path, line)


def _milli(values: Sequence[float]) -> list[float]:
    return [1e3 * value for value in values]


def _degrees(rotation: Vector3) -> list[float]:
    return [math.degrees(angle) for angle in rotation]


def _angle(one: Pose, other: Pose) -> float:
    """Between two orientations [rad]."""
    dot = sum(p * q for p, q in zip(one.orientation, other.orientation, strict=True))
    return 2.0 * math.acos(min(abs(dot), 1.0))
