"""The robots that ship, by name: whatever has a file in `sim/robots/models/`."""

import importlib
import pkgutil
from functools import cache

from sim.exceptions import UnknownRobot
from sim.robots import models
from sim.robots.robot import Manipulator

DEFAULT_NAME = "tiago"

NAMES: tuple[str, ...] = (
    DEFAULT_NAME,
    *sorted({module.name for module in pkgutil.iter_modules(models.__path__)} - {DEFAULT_NAME}),
)
"""The default one first."""


@cache
def robot(name: str) -> Manipulator:
    """Return the robot of that name.

    Raises:
        UnknownRobot: None that ships has it.
    """
    if name not in NAMES:
        raise UnknownRobot(name, NAMES)
    found: Manipulator = importlib.import_module(f"{models.__name__}.{name}").ROBOT
    return found


DEFAULT: Manipulator = robot(DEFAULT_NAME)
"""The one that stands in a scene where nobody says another."""
