"""The other libraries, where they are installed (extra `bench`), and a method that only exists for Python 2."""

from importlib import import_module

import numpy as np

from tests.bench.support.timing import Contender


def peer(name, module, make, effort):
    """The contenders that `make` builds from a library's module, or why there are none."""
    if not effort.peers:
        return [Contender(name, None, note="left out")]
    try:
        return make(import_module(module))
    except ImportError:
        return [Contender(name, None, note="not installed")]


class PromplibsMethod:
    """The method that promplib published, written anew: one 1-D primitive a joint, refitted with each demonstration.

    Paraschos et al., "Probabilistic movement primitives" (2013): normalised Gaussian basis functions, weights by the
    normal equations, mean and covariance of the weights, conditioning on a via-point, deviations from the full
    covariance of the trajectory.
    """

    def __init__(self, K, samples, deviation):
        phases, centres = np.linspace(0.0, 1.0, samples), np.linspace(0.0, 1.0, K)
        bumps = np.exp(-0.5 * ((phases[:, None] - centres) / deviation) ** 2)
        self.samples = samples
        self.Phi = bumps / bumps.sum(axis=1, keepdims=True)
        self.weights, self.mean, self.covariance = [], [], []

    def fit(self, demonstrations):
        """Of motions (steps, d), one added after the other, the moments taken anew each time."""
        for y in demonstrations:
            t = np.linspace(0.0, 1.0, len(y))
            resampled = [np.interp(np.linspace(0.0, 1.0, self.samples), t, column) for column in y.T]
            self.weights.append([np.linalg.inv(self.Phi.T @ self.Phi) @ self.Phi.T @ column for column in resampled])
            W = np.array(self.weights).transpose(1, 0, 2)
            self.mean = [w.mean(axis=0) for w in W]
            self.covariance = [np.cov(w.T) if len(w) > 1 else np.zeros((w.shape[1],) * 2) for w in W]
        return self

    def conditioned(self, goal, variance=1e-5):
        """Mean and deviations of each joint, given that it ends at its goal."""
        phi = self.Phi[-1]
        trajectories = []
        for w, Sigma, end in zip(self.mean, self.covariance, goal, strict=True):
            gain = Sigma @ phi / (variance + phi @ Sigma @ phi)
            mean, covariance = w + gain * (end - phi @ w), Sigma - np.outer(gain, phi @ Sigma)
            deviations = np.sqrt(np.abs(np.diag(self.Phi @ covariance @ self.Phi.T)))
            trajectories.append((self.Phi @ mean, deviations))
        return trajectories
