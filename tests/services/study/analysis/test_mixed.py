"""Mixed models: the analysis of variance where a study is balanced, statsmodels by hand where it is not."""

import warnings

import numpy as np
import pytest
from statsmodels.regression.mixed_linear_model import MixedLM

from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Measure
from services.study.analysis.mixed import fitted
from services.study.analysis.observations import Observations
from services.study.analysis.reml import reml
from tests.services.study.analysis.studies import METHODS, changed, study


def crossed(rng, people=9, levels=4, between=4.0):
    """Values of people by levels, all of them there, and what a design has of them."""
    y = rng.normal(0.0, between, (people, 1)) + np.arange(levels) + rng.normal(0.0, 1.0, (people, levels))
    design = np.column_stack([np.ones(y.size), *(np.tile(np.arange(levels) == i, people) for i in range(1, levels))])
    return y, design.astype(float), np.repeat(np.arange(people), levels).astype(str)


def test_a_balanced_study_has_the_variances_of_the_analysis_of_variance():
    y, design, people = crossed(np.random.default_rng(0))
    found = reml(y.ravel(), design, people)
    residual = y - y.mean(axis=0) - y.mean(axis=1, keepdims=True) + y.mean()
    within = np.sum(residual**2) / ((y.shape[0] - 1) * (y.shape[1] - 1))
    between = np.var(y.mean(axis=1), ddof=1) - within / y.shape[1]
    assert found.within == pytest.approx(within, rel=1e-6)
    assert found.between == pytest.approx(between, rel=1e-6)
    assert found.coefficients[1:] == pytest.approx(y.mean(axis=0)[1:] - y.mean(axis=0)[0])


def test_people_who_do_not_differ_are_a_variance_of_nothing_and_no_failure():
    y, design, people = crossed(np.random.default_rng(1), between=0.0)
    y -= y.mean(axis=1, keepdims=True)
    found = reml(y.ravel(), design, people)
    assert found.between == 0.0
    assert found.within == pytest.approx(np.sum((y - y.mean(axis=0)) ** 2) / (y.size - y.shape[1]))


@pytest.mark.parametrize("seed", range(5))
def test_an_unbalanced_study_is_estimated_as_statsmodels_does(seed):
    rng = np.random.default_rng(seed)
    y, design, people = crossed(rng, people=12, between=0.7)
    kept = rng.random(y.size) < 0.75
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about a variance that it looks at on its way
        expected = MixedLM(y.ravel()[kept], design[kept], people[kept]).fit(reml=True, method=["cg"])
    found = reml(y.ravel()[kept], design[kept], people[kept])
    assert found.coefficients == pytest.approx(np.asarray(expected.fe_params), abs=1e-4)
    assert found.within == pytest.approx(expected.scale, rel=1e-3)
    assert found.between == pytest.approx(float(np.asarray(expected.cov_re)[0, 0]), rel=1e-2, abs=1e-3)


def test_errors_are_those_of_generalised_least_squares():
    rng = np.random.default_rng(6)
    y, design, people = crossed(rng, people=12, between=0.7)
    kept = rng.random(y.size) < 0.75
    found = reml(y.ravel()[kept], design[kept], people[kept])
    same = people[kept][:, None] == people[kept][None, :]
    v = found.between * same + found.within * np.eye(kept.sum())
    expected = np.linalg.inv(design[kept].T @ np.linalg.solve(v, design[kept]))
    assert found.covariance == pytest.approx(expected, rel=1e-6)


def test_workload_without_an_order_is_the_repeated_measures_analysis_of_variance():
    made = study(np.random.default_rng(2), easier=9.0)
    unordered = Observations(
        outcomes=changed(made, lambda one: type(one)(**{**_fields(one), "position": None})).outcomes,
        ratings=made.ratings,
    )
    found = fitted(unordered, Measure.WORKLOAD, Sample.PLANNED, 0.95)
    y = np.array(
        [
            [next(r.workload for r in made.ratings if (r.participant, r.method) == (p, m)) for m in METHODS]
            for p in made.participants
        ]
    )
    n, k = y.shape
    residual = y - y.mean(axis=0) - y.mean(axis=1, keepdims=True) + y.mean()
    f = (n * np.sum((y.mean(axis=0) - y.mean()) ** 2) / (k - 1)) / (np.sum(residual**2) / ((n - 1) * (k - 1)))
    (factor,) = found.factors
    assert factor.freedom == (k - 1, (n - 1) * (k - 1))
    assert factor.statistic == pytest.approx(f, rel=1e-6)


def _fields(one):
    return {name: getattr(one, name) for name in one.__struct_fields__}


def test_a_time_is_explained_as_a_ratio():
    found = fitted(study(np.random.default_rng(3), people=60, online=3.0), Measure.SECONDS, Sample.PLANNED, 0.95)
    ratio = next(one for one in found.coefficients if (one.factor, one.level) == ("method", "OffKey"))
    assert ratio.against == "OnStyl"
    assert ratio.ratio_low < 3.0 < ratio.ratio_high


def test_two_people_are_too_few_and_it_says_so():
    found = fitted(study(np.random.default_rng(4), people=2), Measure.SECONDS, Sample.PLANNED, 0.95)
    assert not found.coefficients
    assert "too few" in found.reason
