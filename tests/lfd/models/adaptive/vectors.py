"""Plain numbers for the tests of the parts of the default model: regressions and corrections without motions."""

import numpy as np

from lfd.models.adaptive.correction import Correction, CorrectionOptions, Corrections
from lfd.models.adaptive.kinds import Kinds
from lfd.models.adaptive.regression import Regression, RegressionOptions
from lfd.models.adaptive.scale import ConditionScale
from lfd.models.anchor import Anchor
from lfd.models.basis import GaussianBasis
from lfd.models.encoding import Encoding

ENCODING = Encoding(GaussianBasis(count=3, width=0.3), 10, np.array([1.0, 0.0, 0.0, 0.0]), anchor=Anchor.straight())
KINDS = Kinds.of(ENCODING)
D = 3 * 6 + 1


def unit_scale(c, axes=None):
    """Numbers that have no unit already; coordinates of a place where axes are given."""
    return ConditionScale(np.zeros(c), np.ones(c), np.full(c, -1) if axes is None else np.array(axes), np.ones(c))


def regression(conditions, vectors, options=None, axes=None):
    conditions = np.asarray(conditions, float)
    scale = unit_scale(conditions.shape[1], axes)
    return Regression(scale, conditions, np.asarray(vectors, float), KINDS, options or RegressionOptions())


def sized(kind, size, rng=None):
    """A vector of that size in a kind, and nothing in the others."""
    vector = np.zeros(D)
    columns = KINDS.columns[kind]
    vector[columns] = np.ones(len(columns)) if rng is None else rng.normal(size=len(columns))
    return vector * (size / np.sqrt(KINDS.sizes(vector[None])[kind, 0]))


def corrections(taught, extent=1.0, **options):
    return Corrections(taught, extent, CorrectionOptions(**options))


def correct(held, s, change, at_s=None):
    """With a correction at s that changes what the demonstrations say there by a vector."""
    s = np.asarray(s, float)
    return held.added(Correction(s, held.regression.at(s).mean + change, at_s))


def effect(held, s):
    return held.effect(held.regression.at(np.asarray(s, float)))


def along(change, kind):
    """How much of `sized(kind, 1.0)` a change is, its sign included."""
    told, unit = (KINDS.measured(x[None])[kind][0] for x in (change, sized(kind, 1.0)))
    return told @ unit
