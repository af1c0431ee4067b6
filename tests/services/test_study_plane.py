"""The thesis' 2D example in its units: conditions, equation (25), what holds, and that all of it can be drawn."""

from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.demonstration import Demonstration
from lfd.trajectory import Trajectory
from protocol.messages import Mode, Verdict
from services.rehearsal.rehearsal import Rehearsed
from services.rehearsal.result import Attempt, Course
from services.study import plane
from services.study.analysis import Holds
from services.study.teaching import Answer
from sim.scenes.particle import PARTICLE, X_UNIT, Y_UNIT

FREE, OBSTACLE = PARTICLE.variants
values = st.floats(-20.0, 20.0)


def level(y, n=50):
    """A motion at one y, in the thesis' units."""
    positions = np.column_stack([np.linspace(0.0, 4.0 * X_UNIT, n), np.full(n, y * Y_UNIT), np.zeros(n)])
    return Trajectory(positions, np.tile([1.0, 0.0, 0.0, 0.0], (n, 1)), 10.0)


def attempt(success, mode=Mode.AUTONOMOUS, y=0.0):
    way = level(y)
    verdict = Verdict(reached=success, kicked_over=False, collision=False)
    return Attempt(mode, 1, verdict, "", way, way, way, way, 0.0)


def answer(first=(), failed=(), beyond=((20.0, 20.0), (5.0, -5.0)), variant=FREE):
    """Both models need refinements under the numbers of `first`, and fail afterwards under those of `failed`."""
    question = plane.question([(0.0, 0.0)], variant, beyond)
    taught = tuple(
        Course(one, (attempt(False), attempt(True, Mode.REFINE, 1.0), attempt(True)), 1)
        if i in first
        else Course(one, (attempt(True),), 0)
        for i, one in enumerate(question.refined)
    )
    again = tuple(Course(one, (attempt(i not in failed),), 0) for i, one in enumerate(question.executed))
    return Answer(question, (Demonstration(level(0.0), np.zeros(3), np.zeros(2)),), (Rehearsed(taught, again),) * 2)


@given(values, values, values)
def test_the_mean_square_error_of_a_level_motion_is_equation_25(y, y_1, y_2):
    condition = (y_1 * Y_UNIT, y_2 * Y_UNIT)
    expected = 0.5 * ((y - y_1) ** 2 + (y - y_2) ** 2)
    assert plane.mean_square_error(level(y), condition) == pytest.approx(expected, abs=1e-9)


def test_the_via_points_are_at_two_and_at_three_and_six_tenths():
    """A motion whose y is its x, in the thesis' units."""
    x = np.linspace(0.0, 4.0, 9)
    positions = np.column_stack([x * X_UNIT, x * Y_UNIT, np.zeros(9)])
    slope = Trajectory(positions, np.tile([1.0, 0.0, 0.0, 0.0], (9, 1)), 10.0)
    np.testing.assert_allclose(plane.missed(slope, (0.0, 0.01)), [2.0, 2.6], atol=1e-9)


def test_nine_conditions_are_taught_row_by_row_and_executed_again_before_the_others():
    question = plane.question([(10.0, 10.0), (-10.0, 0.0)], OBSTACLE, [(20.0, -20.0)])
    names = [plane.named(one.condition) for one in question.executed]
    assert names[:3] == ["[-10, -10]", "[-10, 0]", "[-10, 10]"]
    assert names[8:] == ["[10, 10]", "[20, -20]"]
    assert question.refined == question.executed[:9]
    assert {one.variant for one in question.executed} == {OBSTACLE}
    assert [(one.variant, plane.named(one.condition)) for one in question.demonstrated] == [
        (FREE, "[10, 10]"),
        (FREE, "[-10, 0]"),
    ]


@pytest.mark.parametrize(
    ("made", "excused", "holds"),
    [
        (answer(first=(0, 1)), (), Holds.YES),
        (answer(first=(0, 1, 2)), (), Holds.DIFFERS),
        (answer(first=(0,), failed=(4,)), (), Holds.NO),
        (answer(first=(0,), failed=(9,)), (), Holds.DIFFERS),
        (answer(first=(0,), failed=(9,)), ((20.0, 20.0),), Holds.YES),
    ],
)
def test_a_claim_holds_where_the_nine_succeed_again_and_the_others_as_in_the_thesis(made, excused, holds):
    assert plane.holds(made, 2, excused) is holds


def test_the_sentence_and_the_rows_count_and_name_what_failed():
    made = answer(first=(0, 3), failed=(9,))
    assert "under 2 of 9 conditions (in the thesis 4)" in plane.sentence(made, 4)
    assert "under 9 of 9 of them and under 1 of 2 new ones, but not under [20, 20]" in plane.sentence(made, 4)
    counts = {row.quantity: (row.thesis, row.conditioned, row.adaptive) for row in plane.rows(made, 4, 2)}
    assert counts["conditions that needed a refinement, of 9"] == (4, 2, 2)
    assert counts["new conditions, of 2"] == (2, 1, 1)


def test_every_figure_is_a_picture():
    made = answer(first=(0,), failed=(10,), variant=OBSTACLE)
    figures = [
        plane.learning_curve(made, "a"),
        plane.second_round(made, "b"),
        plane.beyond(made, (20.0, 5.0), "c"),
        plane.demonstrations(made, "d"),
    ]
    assert len({figure.name for figure in figures}) == len(figures)
    for figure in figures:
        assert ElementTree.fromstring(figure.image).tag.endswith("svg")


@pytest.mark.sim
def test_the_first_round_is_a_picture_for_each_model():
    figures = plane.first_rounds(answer(first=(0,)), "Predictions")
    assert [figure.name for figure in figures] == ["first-promp", "first-adaptive"]
    assert [figure.caption for figure in figures] == ["Predictions: thesis' method.", "Predictions: default model."]
