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
from services.reproduction.models import BY_NAME, THESIS
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


def answer(first=(WELL, WELL), second=(WELL, WELL), **others):
    """Every model alike, but for the first rounds of those that are named."""
    rounds = {name: Rehearsed(others.get(name, first), second) for name in BY_NAME}
    return Answer(Question(DISHWASHER, (), (HERE,) * 2, (HERE,) * 2), (), rounds)


@pytest.mark.parametrize(("first", "holds"), [((CORRECTED, WELL), True), ((CORRECTED, CORRECTED), False)])
def test_the_claim_that_few_are_refined_holds_up_to_as_many_as_in_the_thesis(first, holds):
    assert teaching.few_needed(answer(promp=first, adaptive=(WELL, WELL)), "Few.", 1).holds is holds


@pytest.mark.parametrize(("second", "holds"), [((WELL, WELL), True), ((WELL, FAILED), False)])
def test_the_claim_that_all_succeed_again_fails_with_one_of_them(second, holds):
    assert teaching.reached_again(answer(second=second), "All.").holds is holds


@pytest.mark.parametrize(
    ("default", "fine", "second", "holds"),
    [
        ((CORRECTED, WELL), (CORRECTED, CORRECTED), (WELL, WELL), [True, True, True]),
        ((CORRECTED, WELL), (WELL, CORRECTED), (WELL, WELL), [True, False, True]),
        ((CORRECTED, CORRECTED), (CORRECTED, CORRECTED), (WELL, FAILED), [False, False, False]),
    ],
)
def test_what_retouch_claims_of_its_default_model_can_fail(default, fine, second, holds):
    claims = teaching.claims(answer(second=second, **{"adaptive": default, "promp-fine": fine}), ())
    assert [claim.holds for claim in claims] == holds


def test_the_table_counts_what_each_model_needed():
    rows = teaching.rows(answer((CORRECTED, CORRECTED), (WELL, FAILED), adaptive=(CORRECTED, WELL)), needed_by_thesis=2)
    assert [(row.thesis, row.values["promp"], row.values["adaptive"]) for row in rows] == [
        (2, 2, 1),
        (None, 2, 1),
        (None, 2, 1),
        (2, 1, 1),
        (True, False, False),
    ]
    assert all(row.values.keys() == BY_NAME.keys() for row in rows)


def test_the_notes_name_the_conditions_that_failed_and_by_how_much():
    thesis, default = teaching.notes(answer((CORRECTED, WELL), (WELL, FAILED), adaptive=(WELL, WELL)))
    assert thesis == (
        "The first person with the thesis' model, condition by condition: 1: prediction missed by 20 mm; reached after"
        " 1 update; 2: reached. In the second round failed 2: missed by 20 mm."
    )
    assert default.startswith(
        "The first person with the default model, condition by condition: 1: reached; 2: reached."
    )


def test_the_second_round_ends_where_the_conditions_beyond_begin():
    found = Answer(
        Question(DISHWASHER, (), (HERE,), (HERE,), (HERE,) * 2), (), {"promp": Rehearsed((WELL,), (WELL, FAILED, WELL))}
    )
    assert found.second(THESIS) == (WELL,)
    assert found.beyond(THESIS) == (FAILED, WELL)


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
