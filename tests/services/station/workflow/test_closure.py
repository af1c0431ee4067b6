"""When the loop has closed, and that knowing it costs the same on the ten thousandth episode."""

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import Attempt, Mode, Outcome
from services.station.workflow.closure import Closure
from tests.services.station.workflow.site import COLLIDED, MISSED, REACHED


def attempt(mode, outcome, version, *, x=0.85, variant="b2", condition=(), hand=None):
    hand = mode is Mode.REFINE if hand is None else hand
    return Attempt("s", (x, 0.0, 0.5), version, hand, outcome, 1.0, variant, mode, condition)


def has_closed(attempts):
    closure = Closure()
    for one in attempts:
        closure = closure.after(one)
    return closure.closed


CLOSED = (
    attempt(Mode.AUTONOMOUS, COLLIDED, 2),
    attempt(Mode.REFINE, REACHED, 2),
    attempt(Mode.AUTONOMOUS, REACHED, 3),
)


def test_the_loop_has_closed_when_all_three_happened_in_order():
    assert has_closed(CLOSED)


def test_what_has_closed_stays_closed_and_remembers_nothing_else():
    closure = Closure(closed=True)
    for one in (attempt(Mode.AUTONOMOUS, COLLIDED, 3), *CLOSED):
        closure = closure.after(one)
    assert closure == Closure(closed=True)


@pytest.mark.parametrize("failure", [MISSED, COLLIDED, Outcome(reached=True, kicked_over=True, collision=False)])
def test_whatever_the_first_prediction_failed_by_counts(failure):
    assert has_closed((attempt(Mode.AUTONOMOUS, failure, 2), *CLOSED[1:]))


@pytest.mark.parametrize(
    "attempts",
    [
        CLOSED[1:],
        CLOSED[:2],
        (CLOSED[0], CLOSED[2], CLOSED[1]),
        (attempt(Mode.AUTONOMOUS, REACHED, 2), *CLOSED[1:]),
        (*CLOSED[:2], attempt(Mode.AUTONOMOUS, REACHED, 2)),
        (*CLOSED[:2], attempt(Mode.AUTONOMOUS, REACHED, 3, x=0.9)),
        (*CLOSED[:2], attempt(Mode.AUTONOMOUS, REACHED, 3, condition=(0.1, 0.0))),
        (*CLOSED[:2], attempt(Mode.AUTONOMOUS, REACHED, 3, variant="b1")),
        (*CLOSED[:2], attempt(Mode.REFINE, REACHED, 3)),
        (*CLOSED[:2], attempt(Mode.AUTONOMOUS, REACHED, 3, hand=True)),
        (CLOSED[0], attempt(Mode.REFINE, REACHED, 2, hand=False), CLOSED[2]),
        (CLOSED[0], attempt(Mode.REFINE, MISSED, 2), CLOSED[2]),
        (*CLOSED[:2], attempt(Mode.AUTONOMOUS, MISSED, 3)),
        (attempt(Mode.REFINE, MISSED, 2), *CLOSED[1:]),
        (CLOSED[0], attempt(Mode.AUTONOMOUS, REACHED, 2, hand=True), CLOSED[2]),
    ],
    ids=[
        "no attempt before",
        "no success",
        "wrong order",
        "no failure",
        "no update",
        "elsewhere",
        "another condition",
        "another variant",
        "a refinement instead",
        "with a hand",
        "a refinement without a hand",
        "a refinement that failed",
        "a failure again",
        "a refinement failed first",
        "a hand in a prediction instead",
    ],
)
def test_the_loop_has_not_closed_when_a_part_is_missing(attempts):
    assert not has_closed(attempts)


def test_the_oldest_refinement_counts_where_updates_were_taken_back():
    first, refined, later = CLOSED
    newer = msgspec.structs.replace(refined, model_version=4)
    assert has_closed((first, refined, newer, later))


@pytest.mark.parametrize(("x", "same"), [(0.02, True), (-0.02, True), (0.021, False), (-0.021, False)])
def test_a_place_is_the_same_within_two_centimetres(x, same):
    first, refined, later = CLOSED
    there = [msgspec.structs.replace(one, object_position=(0.0, 0.0, 0.5)) for one in (first, refined)]
    assert has_closed((*there, msgspec.structs.replace(later, object_position=(x, 0.0, 0.5)))) is same


def by_definition(attempts):
    """All threes of the run: what the closure is, without regard to its cost."""
    return any(
        first.mode is Mode.AUTONOMOUS
        and not first.verdict.success
        and refined.mode is Mode.REFINE
        and refined.operator_input
        and refined.verdict.success
        and later.mode is Mode.AUTONOMOUS
        and not later.operator_input
        and later.verdict.success
        and later.model_version > refined.model_version
        and (later.variant, later.condition) == (first.variant, first.condition)
        and abs(later.object_position[0] - first.object_position[0]) <= 0.02
        for i, first in enumerate(attempts)
        for j, refined in enumerate(attempts[i + 1 :], i + 1)
        for later in attempts[j + 1 :]
    )


Attempts = st.lists(
    st.builds(
        attempt,
        st.sampled_from(Mode),
        st.sampled_from([MISSED, COLLIDED, REACHED]),
        st.integers(1, 4),
        x=st.sampled_from([0.8, 0.9]),
        variant=st.sampled_from(["b1", "b2"]),
        hand=st.booleans(),
    ),
    max_size=12,
)


@given(Attempts)
def test_it_is_remembered_as_it_is_defined(attempts):
    assert has_closed(attempts) == by_definition(attempts)


def test_what_is_remembered_does_not_grow_with_the_run():
    closure = Closure()
    for number in range(100):
        closure = closure.after(attempt(Mode.AUTONOMOUS, MISSED, 2, x=float(number)))
    assert len(closure.failures) == 32
    assert closure.failures[-1].attempt.object_position[0] == 99.0
    again = closure.after(msgspec.structs.replace(closure.failures[-1].attempt, model_version=3))
    assert again == closure


def test_the_first_motion_that_an_empty_skill_is_shown_answers_that_nothing_was_predicted():
    shown = Closure().after(attempt(Mode.TEACH, REACHED, 0, hand=True), empty=True)
    assert not shown.closed
    assert shown.after(attempt(Mode.AUTONOMOUS, REACHED, 1)).closed


def test_what_an_empty_skill_is_shown_and_fails_answers_nothing():
    shown = Closure().after(attempt(Mode.TEACH, MISSED, 0, hand=True), empty=True)
    assert not shown.after(attempt(Mode.AUTONOMOUS, REACHED, 1)).closed
