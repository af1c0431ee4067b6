"""The baselines on what people demonstrated: figures that were measured elsewhere, with other code."""

import pytest

from tests import recordings as recorded
from tests.bench.evaluation.left_out import leave_out


@pytest.fixture(scope="module")
def sets():
    if not recorded.FOLDER.is_dir():
        pytest.skip(f"the recordings are not at {recorded.FOLDER}")
    return recorded.sets(recorded.FOLDER)


@pytest.mark.data
def test_the_mean_from_the_start_is_hard_to_beat_where_motions_are_alike(sets):
    assert leave_out("mean + anchor", "one_plane", sets["one_plane"]).time == pytest.approx(0.0193, abs=5e-5)


@pytest.mark.data
@pytest.mark.parametrize(
    ("model", "of_all", "of_several"),
    [
        ("thesis", 0.088, 0.060),
        ("thesis + anchor", 0.077, 0.059),
        ("mean + anchor", 0.059, 0.062),
        ("nearest + anchor", 0.063, 0.066),
    ],
)
def test_the_mean_over_the_sets_is_as_it_was_measured_before(sets, model, of_all, of_several):
    rows = [leave_out(model, name, demonstrations) for name, demonstrations in sets.items()]
    assert sum(r.time for r in rows) / len(rows) == pytest.approx(of_all, abs=6e-4)
    several = [r.time for r in rows if r.conditions > 2]
    assert sum(several) / len(several) == pytest.approx(of_several, abs=6e-4)
