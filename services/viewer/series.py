"""Numbers over time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import rerun as rr

from services.viewer import entities, palette
from services.viewer.run import Run

_AXES = ("x", "y", "z")
_LATENCIES = ("operator to robot [ms]", "object pose error [mm]")


def log_legends(run: Run) -> None:
    """Name and colour what has a fixed number of lines."""
    force = rr.SeriesLines(names=[f"{axis} [N]" for axis in _AXES], colors=palette.AXES, widths=[1.5])
    offset = rr.SeriesLines(names=[f"{axis} [mm]" for axis in _AXES], colors=palette.AXES, widths=[1.5])
    turn = rr.SeriesLines(names=[f"about {axis} [deg]" for axis in _AXES], colors=palette.AXES_TURNED, widths=[1.5])
    run.log_always(entities.FORCE_SERIES, force)
    run.log_always(f"{entities.CORRECTION}/offset", offset)
    run.log_always(f"{entities.CORRECTION}/turn", turn)
    for name, colour in zip(_LATENCIES, (palette.REFINED, palette.PREDICTED), strict=True):
        line = rr.SeriesLines(names=[name], colors=[colour], widths=[1.5])
        run.log_always(f"{entities.LATENCY}/{name.split(' [')[0].replace(' ', '_')}", line)


def log_joint_legend(run: Run, names: Sequence[str]) -> None:
    """Name and colour the joints."""
    colours = np.resize(palette.JOINTS, len(names))
    line = rr.SeriesLines(names=[name.removesuffix("_joint") for name in names], colors=colours, widths=[1.5])
    run.log_always(entities.JOINTS, line)


def log_joints(run: Run, q: Sequence[float]) -> None:
    """Joint positions [rad, torso m]."""
    run.log(entities.JOINTS, rr.Scalars(q))


def log_force(run: Run, force: Sequence[float]) -> None:
    """What the master renders to the hand, base axes [N]."""
    run.log(entities.FORCE_SERIES, rr.Scalars(force))


def log_correction(run: Run, offset: Sequence[float], turn: Sequence[float]) -> None:
    """The correction as the robot applies it, in base axes: offset [m] and rotation vector [rad]."""
    run.log(f"{entities.CORRECTION}/offset", rr.Scalars(1e3 * np.asarray(offset)))
    run.log(f"{entities.CORRECTION}/turn", rr.Scalars(np.degrees(turn)))


def log_latency(run: Run, latency_s: float) -> None:
    """From the operator's sample to its effect [s]; negative where it is not known."""
    if latency_s >= 0.0:
        run.log(f"{entities.LATENCY}/operator_to_robot", rr.Scalars([1e3 * latency_s]))


def log_pose_error(run: Run, error: float) -> None:
    """Distance of the object as seen from where it is [m]; negative where it is not known."""
    if error >= 0.0:
        run.log(f"{entities.LATENCY}/object_pose_error", rr.Scalars([1e3 * error]))
