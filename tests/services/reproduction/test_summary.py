"""What runs of several people come to."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.offline.proportion import Proportion
from services.reproduction.analysis import Analysis, Claim, Finding, Relation, Row, Source
from services.reproduction.summary import VARIES, Estimate, Holds, judged, summarised

amounts = st.lists(st.floats(0.0, 10.0), min_size=2, max_size=25)


def claim(value, bound=2.0, relation=Relation.AT_MOST):
    return Claim(Source.THESIS, "It is so.", "amount", value, relation, bound)


def analysis(*, person=True):
    return Analysis("one", "Fig. 0", "What?", "Words.", lambda _: None, 1.0, person)


@pytest.mark.parametrize(
    ("relation", "held"),
    [
        (Relation.BELOW, [True, False, False]),
        (Relation.AT_MOST, [True, True, False]),
        (Relation.AT_LEAST, [False, True, True]),
        (Relation.ABOVE, [False, False, True]),
    ],
)
def test_a_claim_holds_where_its_figure_stands_in_the_relation_to_the_bound(relation, held):
    assert [claim(value, 2.0, relation).holds for value in (1.0, 2.0, 3.0)] == held
    assert not claim(float("nan"), 2.0, relation).holds


@pytest.mark.parametrize(
    ("holding", "people", "holds"),
    [(20, 20, Holds.YES), (15, 20, Holds.YES), (14, 20, Holds.UNDECIDED), (6, 20, Holds.UNDECIDED), (5, 20, Holds.NO)],
)
def test_a_claim_about_people_is_decided_by_the_interval(holding, people, holds):
    runs = [claim(1.0)] * holding + [claim(3.0)] * (people - holding)
    found = judged(runs, person=True)
    assert found.holds is holds
    assert found.held == Proportion(holding, people)


@given(st.integers(0, 40), st.integers(1, 40))
def test_few_people_decide_nothing_and_no_claim_both_holds_and_does_not(holding, failing):
    runs = [claim(1.0)] * holding + [claim(3.0)] * failing
    found = judged(runs, person=True)
    low, high = found.held.interval
    assert (found.holds is Holds.UNDECIDED) == (low <= 0.5 <= high)
    if len(runs) < 4:
        assert found.holds is Holds.UNDECIDED


def test_a_claim_in_which_nobody_takes_part_holds_or_does_not():
    assert judged([claim(2.0)], person=False).holds is Holds.YES
    assert judged([claim(2.1)], person=False).holds is Holds.NO


@given(amounts)
def test_the_interval_of_a_mean_is_student_s_within_what_can_be(values):
    from scipy.stats import ttest_1samp

    found = Estimate.of(values, total=10.0)
    assert 0.0 <= found.low <= found.mean * (1 + 1e-12) + 1e-12
    assert found.mean * (1 - 1e-12) - 1e-12 <= found.high <= 10.0 + 1e-12
    if np.std(values) > 1e-3:
        low, high = ttest_1samp(values, 0.0).confidence_interval()
        np.testing.assert_allclose([found.low, found.high], np.clip([low, high], 0.0, 10.0), atol=1e-9)


def test_cells_are_means_counts_of_people_or_texts():
    def run(number, yes, text):
        row = Row("q", {"a": number, "b": yes, "c": text, "d": "always"}, total=4)
        return Finding((claim(number),), (row,), notes=(f"{number}",))

    found = summarised(analysis(), [run(1, True, "x"), run(3, False, "y")], 5.0)
    cells = found.rows[0].cells
    assert cells["a"].mean == 2.0
    assert cells["b"] == Proportion(1, 2)
    assert (cells["c"], cells["d"]) == (VARIES, "always")
    assert (found.people, found.seconds, found.notes) == (2, 5.0, ("1",))
    assert summarised(analysis(person=False), [run(1, True, "x")], 5.0).people == 0


def test_claims_are_counted_in_words():
    assert [holds.of(count) for holds in Holds for count in (1, 2)] == [
        "1 holds",
        "2 hold",
        "1 does not hold",
        "2 do not hold",
        "1 undecided",
        "2 undecided",
    ]
