"""Order and learning: what was put into a study is found, and what was not is not claimed."""

import msgspec
import numpy as np

from services.study.analysis.backgrounds import influences, spearman
from services.study.analysis.carry_over import carry_over
from services.study.analysis.hypotheses import Measure, Plan
from services.study.analysis.learning import attempts, courses
from services.study.analysis.observations import Trial
from tests.services.study.analysis.studies import changed, study


def checks(observations):
    found = carry_over(observations.arranged(Plan().methods), Plan(), [Measure.SECONDS])
    return {one.question.split(" (")[0]: one for one in found}


def test_what_the_method_before_leaves_is_found():
    found = checks(study(np.random.default_rng(0), people=40, carried=0.5))
    assert found["does the method before matter"].p < 0.001


def test_without_any_it_is_as_often_found_as_chance_has_it():
    rng = np.random.default_rng(1)
    p = [checks(study(rng, people=12, models=1))["does the method before matter"].p for _ in range(120)]
    assert np.mean(np.array(p) < 0.05) < 0.11


def test_sequences_are_the_groups_and_orders_what_came_first():
    found = checks(study(np.random.default_rng(2)))
    assert found["do groups of one sequence differ over all methods together?"].test.startswith("Kruskal-Wallis, H(3)")
    assert found["is online against offline different where online came first?"].people == 18


def test_a_table_without_positions_says_that_it_has_none():
    made = changed(study(np.random.default_rng(3)), lambda one: msgspec.structs.replace(one, position=None))
    (only,) = carry_over(made, Plan(), [Measure.SECONDS])
    assert only.reason == "the positions of the methods are not known"


def test_times_that_fall_from_model_to_model_are_found():
    model, position = courses(study(np.random.default_rng(4), learnt=0.4))
    assert model.p < 0.001
    assert model.medians[1] > model.medians[2] > model.medians[3]
    assert position.p > 0.01


def test_methods_that_differ_are_no_learning_from_position_to_position():
    rng = np.random.default_rng(5)
    p = [courses(study(rng, people=11, online=4.0))[1].p for _ in range(60)]
    assert 0.0 <= np.mean(np.array(p) < 0.05) < 0.15


def test_attempts_are_counted_by_method_and_number():
    made = study(np.random.default_rng(6), people=2)
    trials = [Trial(participant="P01", method="OnKey", model=1, number=n, success=n > 1) for n in (1, 2)]
    trials += [Trial(participant="P02", method="OnKey", model=1, number=1, success=True)]
    found = attempts(msgspec.structs.replace(made, trials=tuple(trials)))
    assert [(one.number, one.successes, one.attempts) for one in found] == [(1, 1, 2), (2, 1, 1)]


def test_a_scale_is_correlated_and_groups_are_compared():
    made = study(np.random.default_rng(7))
    said = tuple(msgspec.structs.replace(b, gender=("man", "woman")[i % 2]) for i, b in enumerate(made.backgrounds))
    found = {
        one.background: one
        for one in influences(msgspec.structs.replace(made, backgrounds=said), Plan(), [Measure.WORKLOAD])
    }
    assert found["age"].scale
    assert found["age"].test.startswith("Spearman's rho")
    assert found["gender"].test == found["gender"].test.replace("Kruskal", "")
    assert "n = 9 and 9, exact" in found["gender"].test


def test_what_everybody_says_tells_nobody_apart():
    found = influences(study(np.random.default_rng(8)), Plan(), [Measure.SECONDS])
    assert next(one for one in found if one.background == "gender").reason == "fewer than two groups of two people"


def test_spearman_s_correlation_is_one_of_what_rises_together():
    assert spearman([1.0, 2.0, 5.0, 9.0], [2.0, 3.0, 4.0, 5.0], 0)[0] == 1.0
