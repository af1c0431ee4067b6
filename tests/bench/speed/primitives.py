"""Movement primitives: fit, condition and update at 10 demonstrations of 100 steps in 7 dimensions."""

from dataclasses import dataclass

import numpy as np

from lfd.models.basis import GaussianBasis, least_squares
from lfd.models.gaussian import JointGaussian, condition, welford
from lfd.models.promp import ConditionedProMP, PrompOptions
from lfd.motion.demonstration import Demonstration
from lfd.motion.rotations import exp_map
from lfd.motion.trajectory import Trajectory
from tests.bench.speed.peers import PromplibsMethod, peer
from tests.bench.support.timing import Contender, compare

M, STEPS, D = 10, 100, 7
WIDTHS = {10: 0.1, 30: 0.035}
GOALS = {10: (0.2, 0.1, 0.15), 30: (0.6, 0.25, 0.45)}  # fit, condition, update [ms]
NOISE = 0.03


@dataclass(frozen=True)
class Core:
    """The thesis' model on plain arrays, from the same functions that `ConditionedProMP` is made of."""

    Phi: np.ndarray
    solver: np.ndarray

    @classmethod
    def make(cls, basis):
        Phi = basis.matrix(np.linspace(0.0, 1.0, STEPS))
        return cls(Phi, least_squares(Phi))

    def fit(self, motions, s):
        """Of motions (M, T, d) at conditions (M, c): equations (3) to (7)."""
        w = self.solver @ motions
        return JointGaussian.fit(np.hstack([w.reshape(len(s), -1), s]))

    def predict(self, joint, s):
        """Mean and variance of each output at each step: equations (8) to (13)."""
        given, K = condition(joint, s, NOISE), self.Phi.shape[1]
        Sigma = np.einsum("kdld->dkl", given.covariance.reshape(K, D, K, D))
        return self.Phi @ given.mean.reshape(K, D), np.einsum("dta,ta->td", self.Phi @ Sigma, self.Phi)

    def update(self, joint, motion, s):
        """Equations (19) and (20)."""
        return welford(joint, np.append(self.solver @ motion, s))


def arrays(rng, count):
    """Motions (count, T, 7) that depend on conditions (count, 3)."""
    t = np.linspace(0.0, 1.0, STEPS)[:, None]
    s = rng.uniform(-0.3, 0.3, (count, 3))
    shapes = np.hstack([t, np.sin(np.pi * t), np.sin(2 * np.pi * t)])
    return np.einsum("tc,mc,cd->mtd", shapes, s, rng.normal(size=(3, D))) + 0.01 * rng.normal(size=(count, 1, D)), s


def demonstrations(rng, count):
    """Reaching motions of STEPS points to objects spread over half a metre."""
    t = np.linspace(0.0, 1.0, STEPS)[:, None]
    smooth, bulge = t * t * (3.0 - 2.0 * t), np.sin(np.pi * t)
    made = []
    for target in rng.uniform([0.6, -0.25, 0.4], [1.1, 0.25, 0.9], (count, 3)):
        start = np.array([0.5, 0.0, 0.5]) + rng.normal(scale=0.02, size=3)
        positions = start + smooth * (target - start) + bulge * rng.normal(scale=0.05, size=3)
        orientations = exp_map(smooth * rng.normal(scale=0.2, size=3))
        made.append(Demonstration.reaching(Trajectory(positions, orientations, rng.uniform(4.0, 8.0)), target))
    return made


def measure(rng, effort):
    results = []
    for K in GOALS if effort.large else (10,):
        results += _measure(rng, K, effort)
    return results


def _measure(rng, K, effort):
    basis = GaussianBasis(K, WIDTHS[K])
    core, (motions, s) = Core.make(basis), arrays(rng, M)
    taught, options = demonstrations(rng, M + 1), PrompOptions(basis=basis, samples=STEPS)
    new, wanted = taught.pop(), s.mean(axis=0)
    joint, model = core.fit(motions, s), ConditionedProMP.fit(taught, options)
    promplib = PromplibsMethod(K, STEPS, WIDTHS[K]).fit(motions)
    theirs = peer(
        "movement_primitives", "movement_primitives.promp", lambda module: _library(module, K, motions), effort
    )
    fit_goal, predict_goal, update_goal = GOALS[K]
    size = f"{M} x {STEPS} x {D}, K = {K}"
    fit = [
        Contender("retouch, basis and solver included", lambda: Core.make(basis).fit(motions, s), fit_goal),
        Contender("retouch, basis and solver kept, as the model does", lambda: core.fit(motions, s)),
        Contender("retouch, whole call: aligned, resampled", lambda: ConditionedProMP.fit(taught, options)),
        *(c for c in theirs if "condition" not in c.name),
        Contender("promplib's method", lambda: PromplibsMethod(K, STEPS, WIDTHS[K]).fit(motions)),
    ]
    predict = [
        Contender("retouch, condition + mean + variance", lambda: core.predict(joint, wanted), predict_goal),
        Contender("retouch, whole call: poses, 3 x 3", lambda: model.predict(new.situation, STEPS)),
        *(c for c in theirs if "condition" in c.name or c.run is None),
        Contender("promplib's method, goal + mean + deviation", lambda: promplib.conditioned(motions[0, -1])),
    ]
    update = [
        Contender("retouch, one motion more", lambda: core.update(joint, motions[0], s[0]), update_goal),
        Contender("retouch, whole call: resampled", lambda: model.updated(new)),
        *(c for c in fit if c.name.startswith(("movement_primitives, weights", "promplib"))),
    ]
    return [
        *compare(f"fit, {size}", fit, effort),
        *compare(f"condition, {size}", predict, effort),
        *compare(f"update, {size} (the peers fit anew)", update, effort),
    ]


def _library(module, K, motions):
    """The contenders of movement_primitives. It changes the times that it is given, so each run makes its own."""

    def times():
        return np.tile(np.linspace(0.0, 1.0, STEPS), (len(motions), 1))

    def imitate():
        promp = module.ProMP(n_dims=D, n_weights_per_dim=K)
        promp.imitate(times(), motions)
        return promp

    def weights():
        promp = module.ProMP(n_dims=D, n_weights_per_dim=K)
        W = np.array([promp.weights(t, y) for t, y in zip(times(), motions, strict=True)])
        return promp.from_weight_distribution(W.mean(axis=0), np.cov(W.T))

    learnt = weights()

    def conditioned():
        given = learnt.condition_position(motions[0, -1], y_cov=1e-5 * np.eye(D), t=1.0, t_max=1.0)
        t = np.linspace(0.0, 1.0, STEPS)
        return given.mean_trajectory(t), given.var_trajectory(t)

    return [
        Contender("movement_primitives, imitate (EM)", imitate),
        Contender("movement_primitives, weights (least squares)", weights),
        Contender("movement_primitives, condition_position + mean + var", conditioned),
    ]
