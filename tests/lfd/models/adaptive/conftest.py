"""Corrections of a regression, for the tests of what they do."""

import pytest

from tests.lfd.models.adaptive.vectors import D, corrections, regression


@pytest.fixture
def taught(rng):
    """Six demonstrations of a plane."""
    conditions = rng.uniform(-0.2, 0.2, size=(6, 2))
    return regression(conditions, conditions @ rng.normal(size=(2, D)) + 1.0)


@pytest.fixture
def none(taught):
    return corrections(taught)
