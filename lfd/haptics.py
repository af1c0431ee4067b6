"""The force that lets the operator feel how far the correction departs from the prediction."""

from typing import TypeVar

from lfd.arrays import Array

STIFFNESS = 50.0  # [N/m] k of equation (14)
DAMPING = 2.0  # [N s/m] d of equation (14)

Quantity = TypeVar("Quantity", float, Array)
"""Of one axis, or of all three, shape (3,)."""


def force(
    displacement: Quantity,
    velocity: Quantity,
    stiffness: float = STIFFNESS,
    damping: float = DAMPING,
    scale: float = 1.0,
) -> Quantity:
    """Equation (14): a spring and a damper towards the neutral position of the master, along one axis or three [N].

    Args:
        displacement: Of the master from its neutral position [m].
        velocity: Of the master, same axes [m/s].
        stiffness: K, the same in all axes [N/m].
        damping: D, the same in all axes [N s/m].
        scale: K_fb [-].
    """
    return -scale * (stiffness * displacement + damping * velocity)
