"""Recordings of people's demonstrations and refinements, from a folder of CSV files.

Layout: demonstrations/<set>/NN.csv with columns t, x, y, z, qw, qx, qy, qz, object_x, object_y, object_z, one sample a
row; refinements/refinements.csv with operator, method, model, update, sample and the same poses and object. Metres,
seconds, base frame. They are not part of the project: whoever reads them says where they are.
"""

import csv
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lfd.exceptions import LfdError
from lfd.motion.demonstration import Demonstration
from lfd.motion.resampling import from_samples
from lfd.motion.trajectory import Trajectory

FOLDER = Path(__file__).resolve().parents[2] / "shared" / "data"

POINTS = 100
REFINEMENT_DURATION = 10.0
"""Refinements were recorded by number, not by time; the experiment executed predictions in 10 s."""

_OBJECT = ("object_x", "object_y", "object_z")
_POSE = ("x", "y", "z", "qw", "qx", "qy", "qz")


class UnusableRecording(Exception):
    """A file that is not as the layout says."""

    def __init__(self, path, reason):
        super().__init__(f"{path}: {reason}")


@dataclass(frozen=True)
class Sequence:
    """Refinements that one operator gave one model with one method, in order."""

    operator: str
    method: str
    model: str
    refinements: tuple[Demonstration, ...]

    @property
    def name(self):
        return f"{self.operator} {self.method} {self.model}"


def demonstration(path):
    """One recorded demonstration."""
    rows = _rows(path, ("t", *_POSE, *_OBJECT))
    times, poses, place = _numbers(path, rows, ("t",)), _numbers(path, rows, _POSE), _numbers(path, rows[:1], _OBJECT)
    try:
        return Demonstration.reaching(from_samples(times[:, 0], poses[:, :3], poses[:, 3:], POINTS), place[0])
    except LfdError as error:
        raise UnusableRecording(path, str(error)) from error


def sets(folder):
    """The demonstrations of each set, by name; sets without a file are left out."""
    found = {}
    for path in sorted((folder / "demonstrations").iterdir()):
        files = sorted(path.glob("*.csv")) if path.is_dir() else []
        if files:
            found[path.name] = [demonstration(file) for file in files]
    return found


def sequences(folder):
    """The refinement sequences in the order of their names; none where the file is not there."""
    path = folder / "refinements" / "refinements.csv"
    if not path.is_file():
        return []
    samples = defaultdict(list)
    for row in _rows(path, ("operator", "method", "model", "update", *_POSE, *_OBJECT)):
        samples[row["operator"], row["method"], row["model"], int(row["update"])].append(row)
    grouped = defaultdict(list)
    for key in sorted(samples):
        poses, place = _numbers(path, samples[key], _POSE), _numbers(path, samples[key][:1], _OBJECT)
        trajectory = Trajectory(poses[:, :3], poses[:, 3:], REFINEMENT_DURATION)
        grouped[key[:3]].append(Demonstration.reaching(trajectory, place[0]))
    return [Sequence(*key, tuple(refinements)) for key, refinements in grouped.items()]


def _rows(path, columns):
    try:
        with path.open(newline="") as file:
            reader = csv.DictReader(file)
            missing = [name for name in columns if name not in (reader.fieldnames or ())]
            if missing:
                raise UnusableRecording(path, f"has no column {', '.join(missing)}")
            rows = list(reader)
    except OSError as error:
        raise UnusableRecording(path, error.strerror or "cannot be read") from error
    if not rows:
        raise UnusableRecording(path, "has no samples")
    return rows


def _numbers(path, rows, columns):
    try:
        return np.array([[float(row[name]) for name in columns] for row in rows])
    except (TypeError, ValueError) as error:
        raise UnusableRecording(path, f"holds what is no number ({error})") from error
