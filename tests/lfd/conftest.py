"""Motions for the tests of lfd: synthetic ones, and the recordings where they are there."""

import csv
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest

from lfd.demonstration import Demonstration
from lfd.resampling import from_samples
from lfd.rotations import exp_map
from lfd.trajectory import Trajectory

RECORDINGS = Path(__file__).resolve().parents[3] / "shared" / "data"


@pytest.fixture
def rng():
    return np.random.default_rng(20210301)


@pytest.fixture
def reach():
    """A function that makes a smooth reaching motion to an object, bulging by `bend` [m] to the side."""

    def make(object_position, bend=0.0, start=(0.5, 0.0, 0.5), duration=5.0, n=60):
        object_position, start = np.asarray(object_position, float), np.asarray(start, float)
        t = np.linspace(0.0, 1.0, n)[:, None]
        smooth = t * t * (3.0 - 2.0 * t)
        positions = start + smooth * (object_position - start) + np.sin(np.pi * t) * [0.0, bend, 0.1]
        orientations = exp_map(smooth * [0.2, -0.3, 0.1] + [0.0, 0.4, 0.0])
        return Demonstration.reaching(Trajectory(positions, orientations, duration), object_position)

    return make


@pytest.fixture(scope="session")
def recordings():
    """A function that reads the recorded demonstrations of one set."""
    if not RECORDINGS.is_dir():
        pytest.skip(f"the recordings are not at {RECORDINGS}")

    def read(name):
        return [_demonstration(path) for path in sorted((RECORDINGS / "demonstrations" / name).glob("*.csv"))]

    return read


@pytest.fixture(scope="session")
def refinements():
    """The recorded refinements, a list for each (operator, method, model), in order."""
    path = RECORDINGS / "refinements" / "refinements.csv"
    if not path.is_file():
        pytest.skip(f"the recorded refinements are not at {path}")
    samples = defaultdict(list)
    with path.open() as file:
        for row in csv.DictReader(file):
            key = row["operator"], row["method"], row["model"], int(row["update"])
            samples[key].append([float(row[name]) for name in COLUMNS])
    sequences = defaultdict(list)
    for key in sorted(samples):
        table = np.array(samples[key])
        # They were recorded by number, not by time; the experiment executed predictions in 10 s.
        trajectory = Trajectory(table[:, 3:6], table[:, 6:], duration=10.0)
        sequences[key[:3]].append(Demonstration.reaching(trajectory, table[0, :3]))
    return list(sequences.values())


COLUMNS = ["object_x", "object_y", "object_z", "x", "y", "z", "qw", "qx", "qy", "qz"]


def _demonstration(path):
    table = np.genfromtxt(path, delimiter=",", names=True)
    columns = np.column_stack([table[name] for name in COLUMNS])
    trajectory = from_samples(table["t"], columns[:, 3:6], columns[:, 6:], n=100)
    return Demonstration.reaching(trajectory, columns[0, :3])
