"""The force that lets the operator feel how far the correction departs from the prediction."""

from lfd.arrays import Array

STIFFNESS = 50.0  # [N/m] k of equation (14)
DAMPING = 2.0  # [N s/m] d of equation (14)


def force(
    displacement: Array, velocity: Array, stiffness: float = STIFFNESS, damping: float = DAMPING, scale: float = 1.0
) -> Array:
    """Equation (14): a spring and a damper towards the neutral position of the master, shape (3,) [N].

    Args:
        displacement: Of the master from its neutral position, shape (3,) [m].
        velocity: Of the master, same axes, shape (3,) [m/s].
        stiffness: K, the same in all axes [N/m].
        damping: D, the same in all axes [N s/m].
        scale: K_fb [-].
    """
    return -scale * (stiffness * displacement + damping * velocity)
