"""What the model predicts, how sure it is, and what became of it under the operator's hand."""

from __future__ import annotations

import numpy as np
import rerun as rr

from protocol.messages import Pose
from services.bus.arrays import Floats
from services.viewer import entities, palette
from services.viewer.run import Run

_ELLIPSOIDS = 24
_THINNEST = 0.001  # [m]
_SIGMAS = 2.0


def log_prediction(run: Run, positions: Floats, deviations: Floats | None) -> None:
    """Draw a prediction and about it two standard deviations, 95 % on each axis.

    Args:
        run: where.
        positions: shape (n, 3), base frame [m].
        deviations: one standard deviation on each axis, shape (n, 3) [m]; None where they are not known.
    """
    line = rr.LineStrips3D([positions], radii=[0.0035], colors=[palette.PREDICTED])
    run.log(entities.PREDICTION, line)
    centres = half_sizes = np.empty((0, 3))
    if deviations is not None and deviations.shape == positions.shape:
        chosen = np.unique(np.linspace(0, len(positions) - 1, _ELLIPSOIDS).round().astype(int))
        centres = positions[chosen]
        half_sizes = np.maximum(_SIGMAS * deviations[chosen], _THINNEST)
    run.log(
        entities.UNCERTAINTY,
        rr.Ellipsoids3D(
            centers=centres,
            half_sizes=half_sizes,
            colors=[palette.UNCERTAINTY],
            fill_mode="solid",
        ),
    )


def log_refined(run: Run, positions: Floats) -> None:
    """Draw the part of the refined motion that lies behind, shape (k, 3) [m]."""
    strips = [positions] if len(positions) > 1 else []
    run.log(entities.REFINED, rr.LineStrips3D(strips, radii=[0.0045], colors=[palette.REFINED]))


def log_waypoints(run: Run, waypoints: tuple[Pose, ...]) -> None:
    """Draw the waypoints that the operator has stored, with the numbers that the page gives them."""
    run.log(
        entities.WAYPOINTS,
        rr.Points3D(
            np.array([waypoint.position for waypoint in waypoints]).reshape(-1, 3),
            radii=[0.009],
            colors=[palette.REFINED],
            labels=[str(number) for number, _ in enumerate(waypoints, 1)],
            show_labels=True,
        ),
    )
