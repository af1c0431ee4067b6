"""The waypoints that an operator stores: a list that s/he edits by number."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import MOST_WAYPOINTS, Method, Origin, Pose
from services.station.press import Press
from services.station.workflow.approach import LEAST_WAYPOINTS, Approach, edited
from tests.services.station.workflow.site import MOTION

numbers = st.sampled_from(["", "0", "1", "2", "3", "9", "-1", "one", "\N{FULLWIDTH DIGIT ONE}"])
presses = st.lists(
    st.builds(Press, st.sampled_from(["store", "delete", "earlier", "later", "clear", "execute"]), numbers), max_size=20
)


def pose(x):
    return Pose((float(x), 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))


def stored(*places):
    return Approach(Method.WAYPOINTS, tuple(map(pose, places)))


def places(approach):
    return [waypoint.position[0] for waypoint in approach.waypoints]


@pytest.mark.parametrize(
    ("press", "after"),
    [
        (Press("store"), [1, 2, 3, 7]),
        (Press("store", "2"), [1, 7, 3]),
        (Press("delete", "1"), [2, 3]),
        (Press("earlier", "3"), [1, 3, 2]),
        (Press("later", "1"), [2, 1, 3]),
        (Press("clear"), []),
        (Press("earlier", "1"), [1, 2, 3]),
        (Press("later", "3"), [1, 2, 3]),
        (Press("delete", "4"), [1, 2, 3]),
        (Press("delete", ""), [1, 2, 3]),
        (Press("store", "0"), [1, 2, 3]),
        (Press("execute"), [1, 2, 3]),
    ],
)
def test_a_press_changes_the_waypoint_of_its_number_and_no_other(press, after):
    assert places(edited(stored(1, 2, 3), (press,), pose(7))) == after


@given(presses)
def test_whatever_is_pressed_the_list_is_one_of_known_poses(made):
    approach = edited(stored(1, 2, 3), tuple(made), pose(7))
    assert set(places(approach)) <= {1.0, 2.0, 3.0, 7.0}
    assert approach.method is Method.WAYPOINTS


@given(st.lists(st.tuples(st.integers(1, 5), st.sampled_from([-1, 1]))))
def test_a_change_of_order_loses_nothing(moves):
    approach = stored(1, 2, 3, 4, 5)
    for number, by in moves:
        approach = approach.moved(str(number), by)
    assert sorted(places(approach)) == [1, 2, 3, 4, 5]


def test_earlier_and_later_undo_each_other():
    assert stored(1, 2, 3).moved("2", -1).moved("1", +1) == stored(1, 2, 3)


def test_where_the_robot_is_not_heard_nothing_is_stored():
    assert edited(stored(1), (Press("store"), Press("store", "1")), None) == stored(1)


def test_no_more_are_stored_than_a_motion_may_have():
    full = stored(*range(MOST_WAYPOINTS))
    assert full.stored(pose(99), "") == full
    assert places(full.stored(pose(99), "1"))[0] == 99


@pytest.mark.parametrize("count", range(5))
def test_so_many_make_a_motion(count):
    assert (stored(*range(count)).replays is Origin.WAYPOINTS) is (count >= LEAST_WAYPOINTS)


def test_waypoints_lead_by_their_own_method_only():
    assert replace(stored(1, 2, 3), method=Method.DEMONSTRATE).replays is None


@pytest.mark.parametrize("name", ["", "teleport", "WAYPOINTS"])
def test_an_unknown_method_or_basis_changes_nothing(name):
    assert stored(1).chosen(name) == stored(1).based(name) == stored(1)


def test_a_refinement_starts_from_the_previous_one_where_there_is_one():
    assert Approach().based("refinement").basis is Origin.MODEL
    assert Approach(previous=MOTION).based("refinement").basis is Origin.REFINEMENT


def test_at_another_place_the_method_stays_and_nothing_else():
    approach = replace(stored(1, 2, 3), previous=MOTION, basis=Origin.REFINEMENT)
    assert approach.elsewhere() == Approach(Method.WAYPOINTS)
