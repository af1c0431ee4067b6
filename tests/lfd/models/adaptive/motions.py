"""Motions for the tests of the default model, and what it makes of them."""

from dataclasses import replace

import numpy as np

from lfd.motion.demonstration import Demonstration
from lfd.motion.rotations import exp_map
from lfd.motion.trajectory import Trajectory

LEFT, MIDDLE, RIGHT = [0.9, 0.3, 0.6], [0.9, 0.0, 0.6], [0.9, -0.3, 0.6]


def predict(model, demonstration, n=None):
    return model.predict(demonstration.situation, n or demonstration.trajectory.n_points)


def gap(model, demonstration):
    """Root mean square distance between the prediction and what was demonstrated at its condition [m]."""
    difference = predict(model, demonstration).trajectory.positions - demonstration.trajectory.positions
    return np.sqrt(np.mean(np.sum(difference**2, axis=1)))


def path(model, demonstration):
    return predict(model, demonstration).trajectory.positions


def decoded(model, demonstration):
    """What the model's basis can express of a demonstration."""
    vector = model.encoding.encode(demonstration)
    return model.encoding.decode(vector, demonstration.situation, demonstration.trajectory.n_points).positions


def straight(condition, n=60):
    """A motion along x that leads y and z linearly to the condition's first and last component."""
    t = np.linspace(0.0, 1.0, n)
    y, z = np.sin(np.pi / 2 * t) * condition[0], t * condition[-1]
    still = np.tile([1.0, 0.0, 0.0, 0.0], (n, 1))
    return Demonstration(Trajectory(np.column_stack([0.4 * t, y, z]), still, 4.0), np.zeros(3), np.array(condition))


def scaled(demonstration, factor=1e3):
    trajectory = demonstration.trajectory
    longer = replace(trajectory, positions=factor * trajectory.positions)
    return Demonstration(longer, factor * demonstration.origin, factor * demonstration.condition)


def anything(rng, c, n=20):
    """A wild motion at a wild condition; now and then the same one again, or one that stands still."""
    kind = rng.integers(4)
    condition = np.zeros(c) if kind == 0 else rng.normal(size=c)
    positions = np.zeros((n, 3)) if kind == 1 else np.cumsum(rng.normal(size=(n, 3)), axis=0)
    orientations = exp_map(np.cumsum(0.3 * rng.normal(size=(n, 3)), axis=0))
    return Demonstration(Trajectory(positions, orientations, rng.uniform(0.5, 20.0)), rng.normal(size=3), condition)


def standard_deviation(model, demonstration):
    return np.sqrt(np.trace(predict(model, demonstration).position_covariances, axis1=1, axis2=2).mean())


def placed(y, size=None, duration=4.0, side=0.0):
    """A motion to a place, its condition in metres; and, if given, the size of what stands there, which lifts it."""
    t = np.linspace(0.0, 1.0, 30)
    lift = 0.0 if size is None else size
    positions = np.column_stack([0.4 * t, t * y + side * np.sin(np.pi * t), 0.1 * t + lift * np.sin(np.pi * t)])
    still = np.tile([1.0, 0.0, 0.0, 0.0], (30, 1))
    condition = [0.4, y, 0.1] if size is None else [y, size]
    return Demonstration(Trajectory(positions, still, duration), np.array([0.4, y, 0.1]), np.array(condition))
