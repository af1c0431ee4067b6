"""A wish for the gripper counts until the motion itself comes to it."""

import numpy as np
import pytest

from services.robot.grasp import Grasp

OPEN, CLOSED = 0.08, 0.0
PICK = np.repeat([OPEN, CLOSED], [8, 12])
PLACE = np.repeat([OPEN, CLOSED, OPEN], [8, 8, 4])


def told(own, said):
    """What the gripper is told where a motion's own openings are these, and the operator says that from a point on."""
    grasp, kept, openings, now = Grasp(), None, [own[0]], None
    for i in range(1, len(own)):
        now = said.get(i, now)
        kept = grasp.asked(now, kept, (own[i - 1], own[i]))
        openings.append(own[i] if kept is None else kept)
    return openings


def changes(openings):
    """At which points, and to what."""
    steps = np.flatnonzero(np.diff(openings)) + 1
    return [(int(i), openings[i]) for i in steps]


def test_nothing_said_is_the_motions_own():
    assert told(PLACE, {}) == PLACE.tolist()


def test_who_closes_earlier_moves_that_moment_and_the_motion_still_opens():
    assert changes(told(PLACE, {5: CLOSED})) == [(5, CLOSED), (16, OPEN)]


def test_who_keeps_it_open_says_when_to_close_and_the_motion_still_opens():
    assert changes(told(PLACE, {5: OPEN, 11: CLOSED})) == [(11, CLOSED), (16, OPEN)]


def test_who_opens_earlier_is_one_with_the_motion_where_it_opens():
    assert changes(told(PLACE, {12: OPEN})) == [(8, CLOSED), (12, OPEN)]


@pytest.mark.parametrize("lost", [6, 7])
def test_what_is_not_said_any_more_is_kept_all_the_same(lost):
    assert changes(told(PICK, {5: CLOSED, lost: None})) == [(5, CLOSED)]


def test_half_closed_ends_where_the_motion_passes_it():
    assert changes(told(PICK, {5: 0.04})) == [(5, 0.04), (8, CLOSED)]


def test_the_same_said_again_after_nothing_is_a_new_wish():
    assert changes(told(PLACE, {5: CLOSED, 10: None, 17: CLOSED})) == [(5, CLOSED), (16, OPEN), (17, CLOSED)]


def test_of_a_motion_without_an_opening_the_last_word_counts():
    grasp = Grasp()
    assert grasp.asked(0.04, None, (None, None)) == 0.04
    assert grasp.asked(None, 0.04, (None, None)) == 0.04
