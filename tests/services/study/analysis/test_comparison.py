"""The hypotheses: what a value is, whom it is about, and what must not matter."""

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from services.study.analysis.analysis import analysed
from services.study.analysis.comparison import compared, confirmatory
from services.study.analysis.exceptions import AnalysisError, UnknownMethod
from services.study.analysis.exclusion import Sample, exclusions, flow_of
from services.study.analysis.hypotheses import Direction, Hypothesis, Measure, Plan
from services.study.analysis.observations import Observations, Training
from services.study.analysis.thesis import thesis_tables
from tests.services.study.analysis.studies import METHODS, changed, study

seeds = st.integers(0, 2**16)
few = settings(max_examples=4, deadline=None)


def planned(observations, plan=Plan()):  # noqa: B008 - it is frozen
    return {r.hypothesis.name: r for r in compared(observations, plan) if r.sample is Sample.PLANNED}


def fail(participant, method, model):
    """A change that lets one model fail."""

    def change(one):
        if (one.participant, one.method, one.model) == (participant, method, model):
            return msgspec.structs.replace(one, adapted=False, seconds=None)
        return one

    return change


def by_hand(observations, first, second):
    """Each participant's mean over methods of the median over models."""

    def of(participant, method):
        return np.median(
            [o.seconds for o in observations.outcomes if (o.participant, o.method) == (participant, method)]
        )

    people = observations.participants
    return [np.mean([of(p, m) for m in first]) - np.mean([of(p, m) for m in second]) for p in people]


def test_a_value_is_a_participant_s_median_and_the_test_scipy_s():
    made = study(np.random.default_rng(0), online=1.2)
    d = by_hand(made, METHODS[:2], METHODS[2:])
    found = planned(made)["online is faster"]
    assert found.pairs == found.people == 18
    assert found.test.p == pytest.approx(stats.wilcoxon(d, alternative="less", method="exact").pvalue)


@few
@given(seeds)
def test_the_order_of_lines_and_people_is_no_matter(seed):
    rng = np.random.default_rng(seed)
    made = study(rng, people=9, online=1.3)
    shuffled = msgspec.structs.replace(
        made,
        outcomes=tuple(rng.permutation(np.array(made.outcomes, dtype=object))),
        ratings=tuple(rng.permutation(np.array(made.ratings, dtype=object))),
        backgrounds=tuple(rng.permutation(np.array(made.backgrounds, dtype=object))),
    )
    assert msgspec.json.encode(analysed(shuffled, Plan())) == msgspec.json.encode(analysed(made, Plan()))


@few
@given(seeds)
def test_whose_code_is_whose_is_no_matter(seed):
    rng = np.random.default_rng(seed)
    made = study(rng, people=8, online=1.2)
    new = dict(zip(made.participants, rng.permutation([f"Q{i}" for i in range(8)]), strict=True))

    def renamed(ones):
        return tuple(msgspec.structs.replace(one, participant=str(new[one.participant])) for one in ones)

    other = Observations(outcomes=renamed(made.outcomes), ratings=renamed(made.ratings))
    assert compared(other, Plan()) == compared(made, Plan())


@few
@given(seeds)
def test_swapping_the_sides_turns_the_signs(seed):
    made = study(np.random.default_rng(seed), online=1.3)
    there = Hypothesis("there", Measure.SECONDS, METHODS[:2], METHODS[2:], Direction.LESS)
    back = Hypothesis("back", Measure.SECONDS, METHODS[2:], METHODS[:2], Direction.GREATER)
    a, b = (planned(made, Plan(hypotheses=(one,)))[one.name] for one in (there, back))
    assert a.test.p == pytest.approx(b.test.p)
    assert a.shift.value == pytest.approx(-b.shift.value)
    assert (a.shift.low, a.shift.high) == pytest.approx((-b.shift.high, -b.shift.low))
    assert a.effect.value == pytest.approx(-b.effect.value)


def test_repeating_every_model_changes_nothing_where_the_participant_is_the_unit():
    made = study(np.random.default_rng(1), online=1.15)
    again = [msgspec.structs.replace(one, model=one.model + 3) for one in made.outcomes]
    twice = msgspec.structs.replace(made, outcomes=(*made.outcomes, *again))
    assert compared(twice, Plan()) == compared(made, Plan())
    theirs = Plan(rules="thesis")
    once, doubled = (planned(one, theirs)["online is faster"].test.p for one in (made, twice))
    assert doubled < once / 3.0, "where each model counts, nothing new was measured and it is surer"


def test_the_thesis_rules_count_a_workload_for_each_model():
    made = study(np.random.default_rng(2), easier=4.0)
    found = planned(made, Plan(rules="thesis"))["online is less work"]
    load = {(one.participant, one.method): one.workload for one in made.ratings}
    d = [
        load[p, on] - load[p, off]
        for on, off in (METHODS[::2], METHODS[1::2])
        for p in made.participants
        for _ in "123"
    ]
    assert (found.pairs, found.people) == (108, 18)
    assert found.test.p == pytest.approx(stats.wilcoxon(d, alternative="less", method="asymptotic").pvalue)
    assert found.adjusted is None
    assert found.effect.value is None


def test_who_fails_in_one_method_is_out_of_the_time_in_all_and_in_the_workload():
    made = changed(study(np.random.default_rng(3)), fail("P05", "OffKey", 2))
    assert exclusions(made) == {"P05": "OffKey: model 2 not adapted"}
    found = planned(made)
    assert found["stylus is faster"].people == 17
    assert found["stylus is less work"].people == 18
    everybody = [r for r in compared(made, Plan()) if r.sample is Sample.ALL]
    assert {r.people for r in everybody} == {18}, "there are two other models of that method"


def test_a_training_that_was_not_passed_excludes_as_well():
    made = study(np.random.default_rng(4))
    failed = Training(participant="P02", method="OffStyl", passed=False, seconds=1800.0)
    made = msgspec.structs.replace(made, trainings=(failed,))
    assert exclusions(made) == {"P02": "OffStyl: training not passed"}
    assert flow_of(made).included == 17


def test_what_was_declared_invalid_is_no_failure_and_no_value():
    made = study(np.random.default_rng(5), models=2)

    def invalid(one):
        broken = (one.participant, one.method, one.model) == ("P01", "OnKey", 2)
        return msgspec.structs.replace(one, valid=False, adapted=False, seconds=1e6) if broken else one

    assert exclusions(changed(made, invalid)) == {}
    assert planned(changed(made, invalid))["online is faster"].people == 18


def test_a_failure_can_be_ranked_behind_every_time():
    made = study(np.random.default_rng(6), online=1.0)

    def change(one):
        return msgspec.structs.replace(one, adapted=False, seconds=None) if one.method == "OffKey" else one

    last = next(
        r
        for r in compared(changed(made, change), Plan())
        if r.sample is Sample.RANKED_LAST and r.hypothesis.name == "online is faster"
    )
    assert last.test.p == pytest.approx(2.0**-18, rel=20.0), "the slowest of all are offline"
    assert last.test.statistic == 0.0
    assert last.people == 18


def test_who_did_not_pass_the_training_is_ranked_last_without_a_model_to_fail():
    made = changed(
        study(np.random.default_rng(6)),
        lambda one: None if (one.participant, one.method) == ("P03", "OffStyl") else one,
    )
    made = msgspec.structs.replace(made, trainings=(Training(participant="P03", method="OffStyl", passed=False),))
    found = {r.sample: r for r in compared(made, Plan()) if r.hypothesis.name == "online is faster"}
    assert (found[Sample.PLANNED].people, found[Sample.ALL].people, found[Sample.RANKED_LAST].people) == (17, 17, 18)


def test_nobody_can_be_compared_and_it_is_no_crash():
    made = changed(study(np.random.default_rng(7)), lambda one: msgspec.structs.replace(one, adapted=False))
    found = planned(made)["online is faster"]
    assert (found.test, found.people, found.rejected) == (None, 0, None)
    assert confirmatory(made, Plan())["online is faster"] is None


def test_exploratory_hypotheses_are_no_part_of_the_family():
    made = study(np.random.default_rng(8), online=1.5)
    one = Hypothesis("one", Measure.SECONDS, METHODS[:2], METHODS[2:])
    also = Hypothesis("also", Measure.UPDATES, METHODS[:2], METHODS[2:], confirmatory=False)
    found = planned(made, Plan(hypotheses=(one, also)))
    assert found["one"].adjusted == found["one"].test.p
    assert found["also"].adjusted is None
    assert found["also"].rejected is None


def test_a_method_that_nobody_used_is_named():
    made = study(np.random.default_rng(9))
    plan = Plan(hypotheses=(Hypothesis("x", Measure.SECONDS, ("OnPen",), ("OffKey",)),))
    with pytest.raises(UnknownMethod, match="'OnPen', which is not in the data"):
        compared(made, plan)


def test_the_thesis_rules_need_as_many_methods_on_both_sides():
    plan = Plan(rules="thesis", hypotheses=(Hypothesis("x", Measure.SECONDS, ("OnStyl",), METHODS[1:]),))
    with pytest.raises(AnalysisError, match="name as many"):
        compared(study(np.random.default_rng(10)), plan)


def test_table_e2_parts_models_by_what_participants_said():
    made = study(np.random.default_rng(11), people=8)
    backgrounds = tuple(
        msgspec.structs.replace(one, gaming="5" if i < 3 else "2") for i, one in enumerate(made.backgrounds)
    )
    parts = [
        p
        for p in thesis_tables(msgspec.structs.replace(made, backgrounds=backgrounds)).by_background
        if (p.background, p.method, p.measure) == ("gaming", "OnStyl", Measure.SECONDS)
    ]
    assert {p.said: p.values for p in parts} == {"high": 9, "low": 15}
    high = [o.seconds for o in made.outcomes if o.method == "OnStyl" and o.participant in ("P01", "P02", "P03")]
    assert next(p for p in parts if p.said == "high").quartiles.lower == pytest.approx(np.percentile(high, 25))


def test_a_model_that_was_not_touched_is_told_from_one_that_failed():
    def change(one):
        if (one.participant, one.method) == ("P01", "OffKey"):
            return msgspec.structs.replace(one, adapted=False, seconds=None, refinements=0 if one.model == 1 else 7)
        return one

    cells = {c.method: c for c in flow_of(changed(study(np.random.default_rng(12)), change)).cells}
    assert cells["OnStyl"].adapted == cells["OffKey"].models == 54
    assert (cells["OffKey"].adapted, cells["OffKey"].failed, cells["OffKey"].untouched) == (51, 2, 1)
