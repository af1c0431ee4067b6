"""What stands in more than one scene."""

from sim.tasks.scene import Box, Vector

_WOOD = (0.72, 0.55, 0.38, 1.0)
_LEG = (0.30, 0.31, 0.33, 1.0)
_THICKNESS = 0.04  # [m] of a table's top
_LEG_WIDTH, _LEG_INSET = 0.05, 0.05  # [m]


def table(centre: Vector, depth: float, width: float) -> list[Box]:
    """A table on four legs.

    Args:
        centre: Of its upper surface [m].
        depth: Along x [m].
        width: Along y [m].
    """
    x, y, z = centre
    half_leg = (z - _THICKNESS) / 2
    legs = [
        Box(
            f"leg_{i}",
            (x + sx * (depth / 2 - _LEG_INSET), y + sy * (width / 2 - _LEG_INSET), half_leg),
            (_LEG_WIDTH / 2, _LEG_WIDTH / 2, half_leg),
            _LEG,
        )
        for i, (sx, sy) in enumerate(((1, 1), (1, -1), (-1, 1), (-1, -1)))
    ]
    top = Box("table_top", (x, y, z - _THICKNESS / 2), (depth / 2, width / 2, _THICKNESS / 2), _WOOD)
    return [top, *legs]
