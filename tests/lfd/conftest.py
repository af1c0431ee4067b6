"""Motions for the tests of lfd: synthetic ones, and the recordings where they are there."""

import numpy as np
import pytest

from lfd.motion.demonstration import Demonstration
from lfd.motion.rotations import exp_map
from lfd.motion.trajectory import Trajectory
from tests import recordings as recorded


@pytest.fixture
def rng():
    return np.random.default_rng(20210301)


@pytest.fixture(scope="session")
def reach():
    """A function that makes a smooth reaching motion to an object, bulging by `bend` [m] to the side."""

    return _reaching


def _reaching(object_position, bend=0.0, start=(0.5, 0.0, 0.5), duration=5.0, n=60):
    object_position, start = np.asarray(object_position, float), np.asarray(start, float)
    t = np.linspace(0.0, 1.0, n)[:, None]
    smooth = t * t * (3.0 - 2.0 * t)
    positions = start + smooth * (object_position - start) + np.sin(np.pi * t) * [0.0, bend, 0.1]
    orientations = exp_map(smooth * [0.2, -0.3, 0.1] + [0.0, 0.4, 0.0])
    return Demonstration.reaching(Trajectory(positions, orientations, duration), object_position)


@pytest.fixture(scope="session")
def recordings():
    """A function that reads the recorded demonstrations of one set."""
    if not recorded.FOLDER.is_dir():
        pytest.skip(f"the recordings are not at {recorded.FOLDER}")
    return lambda name: [
        recorded.demonstration(path) for path in sorted((recorded.FOLDER / "demonstrations" / name).glob("*.csv"))
    ]


@pytest.fixture(scope="session")
def refinements():
    """The recorded refinements, a tuple for each (operator, method, model), in order."""
    found = recorded.sequences(recorded.FOLDER)
    if not found:
        pytest.skip(f"the recorded refinements are not at {recorded.FOLDER}")
    return [sequence.refinements for sequence in found]
