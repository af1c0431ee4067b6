"""Both models through the same conditions: what is asked, and what is said of what came out."""

import numpy as np
import pytest

from lfd.motion.trajectory import Trajectory
from protocol.messages import Mode, Verdict
from services.offline.rehearsal import Rehearsed
from services.offline.result import Arrangement, Attempt, Course
from services.reproduction import teaching
from services.reproduction.analyses import dishwasher, initial_poses, table
from services.reproduction.analyses.particle import mean_squared_error
from services.reproduction.analysis import Holds
from services.reproduction.teaching import Answer, Question
from sim.tasks import DISHWASHER
from sim.tasks.particle import PARTICLE, Y_UNIT

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
STILL = Trajectory(np.zeros((2, 3)), np.tile(UPRIGHT, (2, 1)), 1.0)
HERE = Arrangement("b2", (0.86, 0.07, 0.553))


def attempt(mode, miss):
    verdict = Verdict(reached=miss == 0.0, kicked_over=False, collision=False)
    return Attempt(mode, 1, verdict, "", STILL, STILL, STILL, STILL, miss)


def course(*misses, updates=0):
    """Autonomous and refined in turns; a miss of zero is a success."""
    modes = [Mode.REFINE if i % 2 else Mode.AUTONOMOUS for i in range(len(misses))]
    return Course(HERE, tuple(map(attempt, modes, misses)), updates)


WELL, FAILED = course(0.0), course(0.02)
CORRECTED = course(0.02, 0.0, 0.0, updates=1)


def answer(conditioned, adaptive, second=(WELL, WELL)):
    kinds = tuple(Rehearsed(first, second) for first in (conditioned, adaptive))
    return Answer(Question(DISHWASHER, (), (HERE,) * 2, (HERE,) * 2), (), kinds, ((), ()))


@pytest.mark.parametrize(
    ("first", "second", "holds"),
    [
        ((CORRECTED, WELL), (WELL, WELL), Holds.YES),
        ((CORRECTED, CORRECTED), (WELL, WELL), Holds.DIFFERS),
        ((WELL, WELL), (WELL, FAILED), Holds.DIFFERS),
        ((CORRECTED, CORRECTED), (WELL, FAILED), Holds.NO),
    ],
)
def test_the_claim_holds_where_few_are_refined_and_all_succeed_again(first, second, holds):
    assert teaching.holds(answer(first, (WELL, WELL), second), needed_by_thesis=1) is holds


def test_the_table_counts_what_each_model_needed():
    rows = teaching.rows(answer((CORRECTED, CORRECTED), (CORRECTED, WELL), (WELL, FAILED)), needed_by_thesis=2)
    assert [(row.thesis, row.conditioned, row.adaptive) for row in rows] == [
        (2, 2, 1),
        (None, 2, 1),
        (None, 2, 1),
        (2, 1, 1),
    ]


def test_the_notes_name_the_conditions_that_failed_and_by_how_much():
    thesis, default = teaching.notes(answer((CORRECTED, WELL), (WELL, WELL), (WELL, FAILED)))
    assert thesis == (
        "Thesis' method, condition by condition: 1: prediction missed by 20 mm; reached after 1 update; 2: reached. In"
        " the second round failed 2: missed by 20 mm."
    )
    assert default.startswith("Default model, condition by condition: 1: reached; 2: reached.")


def test_the_sentence_says_where_the_second_round_failed():
    said = teaching.sentence(answer((CORRECTED, WELL), (WELL, WELL), (WELL, FAILED)), needed_by_thesis=2)
    assert "refinements under 1 of 2 conditions (in the thesis 2), the default model under 0" in said
    assert "the thesis' method failed under 1 of 2, the default model under 1" in said


def test_the_baskets_outer_places_are_demonstrated_and_all_four_refined():
    asked = dishwasher.question()
    assert [one.variant for one in (*asked.demonstrated, *asked.refined)] == ["b1"] * 2 + ["b2"] * 4
    places = [one.object_position for one in asked.refined]
    assert [one.object_position for one in asked.demonstrated] == [places[0], places[-1]]
    assert places[0][1] - places[-1][1] == pytest.approx(0.3)  # in the order of Fig. 23


def test_the_tables_three_and_six_places_are_one_grid():
    asked = table.question()
    places = [one.object_position for one in (*asked.demonstrated, *asked.refined)]
    assert len(asked.demonstrated) == 3
    assert len(set(places)) == len(set(asked.executed)) == 9
    assert [len({place[axis] for place in places}) for axis in (0, 1, 2)] == [3, 3, 1]


def test_the_initial_poses_lie_evenly_around_the_scenes_own():
    asked = initial_poses.question()
    starts = np.array([one.start.position for one in asked.executed]) - DISHWASHER.start.position
    np.testing.assert_allclose(np.abs(starts).max(axis=0), 0.1)
    np.testing.assert_allclose(np.linalg.norm(starts, axis=1), np.linalg.norm(starts[0]))
    apart = np.linalg.norm(starts[:, None] - starts[None], axis=2)
    nearest = np.sort(apart, axis=1)[:, 1:6]
    np.testing.assert_allclose(nearest, nearest[0, 0])
    for group in (starts[:6], starts[6:]):
        assert {tuple(row) for row in group.round(9).tolist()} == {tuple(row) for row in (-group).round(9).tolist()}


@pytest.mark.parametrize(("off", "expected"), [((0.0, 0.0), 0.0), ((3.0, -1.0), 5.0)])
def test_the_error_is_equation_25_in_the_thesis_units(off, expected):
    place = Y_UNIT * np.array([10.0, -10.0])
    positions = PARTICLE.corridor("free", place + Y_UNIT * np.array(off)).positions
    prediction = Trajectory(positions, np.tile(UPRIGHT, (len(positions), 1)), 10.0)
    assert mean_squared_error(prediction, place) == pytest.approx(expected, abs=1e-9)
