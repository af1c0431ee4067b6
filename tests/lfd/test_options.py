"""Every option has bounds, and what is beyond them is refused by its name before anything is computed."""

import math
from dataclasses import fields

import numpy as np
import pytest

from lfd.exceptions import OutOfRange, TooFewPoints
from lfd.models.adaptive.adaptation import AdaptiveOptions
from lfd.models.adaptive.correction import CorrectionOptions
from lfd.models.adaptive.covariance import CovarianceOptions
from lfd.models.adaptive.drift import DriftOptions
from lfd.models.adaptive.regression import RegressionOptions
from lfd.models.adaptive.relevance import RelevanceOptions
from lfd.models.adaptive.spread import SpreadPrior
from lfd.models.adaptive.trend import TrendOptions
from lfd.models.adaptive.worlds import WorldOptions
from lfd.models.anchor import Anchor
from lfd.models.basis import GaussianBasis
from lfd.models.dmp import DMP, DmpOptions
from lfd.models.encoding import Encoding
from lfd.models.gaussian import JointGaussian, condition, welford
from lfd.models.promp import ConditionedProMP, PrompOptions
from lfd.motion.alignment import align
from lfd.motion.refinement import refine
from lfd.motion.resampling import from_samples, resample
from lfd.motion.waypoints import through_waypoints

NEVER = [math.nan, math.inf, -math.inf, "ten", None]
BEYOND = {
    GaussianBasis: {"count": [1, 0, -3, 2.5], "width": [0.0, -0.1, 0.001]},
    PrompOptions: {
        "basis": [10],
        "samples": [1, 0, 10.0],
        "conditioning_noise": [0.0, -1.0],
        "observation_std": [-1e-9],
        "selection": ["similar pair"],
        "kept": [0.0, 1.1, -1.0],
        "anchored": ["yes"],
    },
    DmpOptions: {
        "count": [1, 9.5],
        "alpha_y": [0.0, -1.0, 1001.0],
        "alpha_x": [0.0, -1.0, 21.0],
        "scaling": ["per axis"],
    },
    RelevanceOptions: {
        "conditions": [2, 8.0],
        "conditions_of_lengths": [2, 8.0],
        "gain": [-0.1, 1.1],
        "most": [2, 60.0],
    },
    SpreadPrior: {
        "position_std": [0.0, -1.0],
        "rotation_std": [0.0, -1.0],
        "duration_std": [0.0, -1.0],
        "count": [0.0, -1.0],
        "moment_std": [0.0, -1.0],
    },
    DriftOptions: {"conditions": [2, 3.5], "doubt": [0.0, -1.0], "least": [0.0, -1.0]},
    WorldOptions: {"noise": [0.0, -1.0], "evidence": [0.0, -1.0], "jump": [0.0, -1.0], "stays": [0.0, -1.0]},
}


NUMBERS_BEYOND = {
    AdaptiveOptions: {
        "basis": [40, None],
        "samples": [1, 75.0, *NEVER],
        "regression": [None],
        "correction": [None],
        "relevance": [None],
        "prior": [None],
        "repeatability": [-0.1, *NEVER],
        "most": [0, 2.0, *NEVER],
    },
    RegressionOptions: {
        "same": [-0.1, *NEVER],
        "near": [0.0, -0.1, *NEVER],
        "near_spread": [-0.1, *NEVER],
        "noise": [0.0, -0.1, *NEVER],
        "sharpness": [-0.1, *NEVER],
        "trend": [None],
    },
    TrendOptions: {"least": [-0.1, *NEVER], "marker_noise": [-0.1, *NEVER], "softness": [0.0, -0.1, *NEVER]},
    CovarianceOptions: {
        "open_slope": [-0.1, *NEVER],
        "near_std": [0.0, -0.1, *NEVER],
        "value_std": [0.0, -0.1, *NEVER],
        "near": [0.0, -0.1, *NEVER],
        "beside": [0.0, -0.1, *NEVER],
    },
    CorrectionOptions: {
        "covariance": [None],
        "world": [None],
        "drift": [None],
        "noise": [0.0, -1.0, *NEVER],
        "same": [-0.1, *NEVER],
        "gate": [0.0, -0.1, *NEVER],
        "half_life_s": [0.0, -1.0, math.nan, math.inf, "ten"],
        "most": [0, 2.0, *NEVER],
    },
}
"""Of the default model: those with other rules, too, stand below."""

WITHIN = {
    RelevanceOptions: {"conditions": 3, "conditions_of_lengths": 3, "gain": 0.0, "most": 3},
    AdaptiveOptions: {"samples": 2, "repeatability": 0.0, "most": 1},
    RegressionOptions: {"same": 0.0, "near": 1e-9, "near_spread": 0.0, "noise": 1e-9, "sharpness": 0.0},
    TrendOptions: {"least": 0.0, "marker_noise": 0.0, "softness": 1e-9, "shrinkages": (0.0, math.inf)},
    CovarianceOptions: {
        "open_slope": 0.0,
        "near_std": 1e-9,
        "value_std": 1e-9,
        "near": 1e-9,
        "beside": 1e-9,
        "reach": (1e-9,) * 3,
    },
    CorrectionOptions: {"noise": 1e-9, "same": 0.0, "gate": 1e-9, "half_life_s": 1e-9, "most": 1},
    DriftOptions: {"conditions": 3, "doubt": 1e-9, "least": 1e-9},
    WorldOptions: {"noise": 1e-9, "evidence": 1e-9, "jump": 1e-9, "stays": 1e-9},
}


@pytest.mark.parametrize("kind", WITHIN)
def test_the_bounds_of_the_default_model_themselves_are_allowed(kind):
    for option, value in WITHIN[kind].items():
        assert getattr(kind(**{option: value}), option) == value


@pytest.mark.parametrize("reach", [(0.0, 1.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0, math.nan), (1.0, 1.0), (1.0,) * 4])
def test_each_reach_is_looked_at(reach):
    with pytest.raises(OutOfRange, match="reach"):
        CovarianceOptions(reach=reach)


@pytest.mark.parametrize("kind", BEYOND)
def test_every_option_is_looked_at(kind):
    assert set(BEYOND[kind]) == {field.name for field in fields(kind)}


@pytest.mark.parametrize(
    ("kind", "option", "value"),
    [
        (kind, option, value)
        for kind, options in BEYOND.items()
        for option, values in options.items()
        for value in [*values, *NEVER]
    ]
    + [
        (kind, option, value)
        for kind, options in NUMBERS_BEYOND.items()
        for option, values in options.items()
        for value in values
    ],
)
def test_what_is_beyond_its_bounds_is_refused_by_option_value_and_bound(kind, option, value):
    with pytest.raises(OutOfRange) as caught:
        kind(**{option: value})
    assert caught.value.name == f"{kind.__name__}.{option}"
    assert caught.value.value is value
    assert caught.value.allowed in str(caught.value)


def test_the_narrowest_basis_says_something_at_every_phase():
    Phi = GaussianBasis(count=20, width=0.02 / 19).matrix(np.linspace(0.0, 1.0, 1001))
    np.testing.assert_allclose(Phi.sum(axis=1), 1.0)


@pytest.mark.parametrize("n", [1, 0, -1])
def test_fewer_than_two_points_are_no_motion_whoever_is_asked(reach, n):
    one = reach([0.9, 0.1, 0.6])
    model, dmp = ConditionedProMP.fit([one]), DMP.fit(one.trajectory, DmpOptions(count=10))
    motion, pose = model.distribution(one.situation), (one.trajectory.positions[0], one.trajectory.orientations[0])
    still = np.tile([1.0, 0.0, 0.0, 0.0], (3, 1))
    for asked in (
        lambda: resample(one.trajectory, n),
        lambda: refine(one.trajectory, one.trajectory, 0.5, n),
        lambda: from_samples([0.0, 1.0, 2.0], np.eye(3), still, n),
        lambda: through_waypoints(np.eye(3), still, 1.0, n),
        lambda: model.predict(one.situation, n),
        lambda: motion.trajectory(n),
        lambda: motion.velocities(n),
        lambda: motion.position_covariances(n),
        lambda: motion.sample(np.random.default_rng(1), 2, n),
        lambda: dmp.reproduce(pose, pose, 1.0, n),
    ):
        with pytest.raises(TooFewPoints) as caught:
            asked()
        assert caught.value.count == n


@pytest.mark.parametrize(
    ("named", "asked"),
    [
        ("tolerance", lambda one: align([one], tolerance=-0.1)),
        ("selection", lambda one: align([one], selection="all of them")),
        ("interpolation", lambda one: resample(one.trajectory, 5, "cubic")),
        ("number of points", lambda one: resample(one.trajectory, 5.0)),
        ("alpha", lambda one: refine(one.trajectory, one.trajectory, math.nan)),
        ("samples", lambda one: Encoding(GaussianBasis(), 1, np.array([1.0, 0.0, 0.0, 0.0]), anchor=Anchor.straight())),
        ("kept", lambda one: welford(JointGaussian(np.zeros(2), np.eye(2), 2), np.ones(2), kept=0.0)),
        ("noise", lambda one: condition(JointGaussian(np.zeros(2), np.eye(2), 2), np.ones(1), noise=-1.0)),
        (
            "number of samples",
            lambda one: ConditionedProMP.fit([one]).distribution(one.situation).sample(np.random.default_rng(1), -1, 9),
        ),
    ],
)
def test_what_a_function_is_given_is_refused_by_its_name(reach, named, asked):
    with pytest.raises(OutOfRange, match=named):
        asked(reach([0.9, 0.1, 0.6]))
