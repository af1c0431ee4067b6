"""Fingers on keys and sticks, a pen on a pad: what they cannot do, however much is left."""

import itertools

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.person.fingers import Fingers, Handling
from sim.person.pen import Pad, Pen

PERIOD = 0.02
RATE, DECAY = np.repeat([0.12, 0.4], 3), np.repeat([0.05, 0.2], 3)
CONTENT, FULL = np.repeat([0.01, 0.1], 3), np.repeat([0.05, 0.3], 3)
KEYS = Handling(RATE, DECAY, CONTENT, FULL, graded=False)
STICKS = Handling(RATE, DECAY, CONTENT, FULL, graded=True, idle=0.12)
PAD = Pad(notch=0.0125, turn_notch=0.04, room=0.3, turn_room=1.0)

lefts = st.lists(
    st.tuples(*[st.floats(-0.2, 0.2)] * 3, *[st.floats(-0.5, 0.5)] * 3).map(np.array), min_size=2, max_size=60
)


def acted(fingers, left):
    return np.array([fingers.act(PERIOD * number, one) for number, one in enumerate(left)])


@given(lefts)
@settings(deadline=None)
def test_a_key_is_down_or_up_and_stays_so_for_a_tenth_of_a_second(left):
    pushed = acted(Fingers(KEYS, np.random.default_rng(0)), left)
    assert set(np.unique(pushed)) <= {-1.0, 0.0, 1.0}
    for way in pushed.T:
        changes = np.flatnonzero(np.diff(way))
        assert np.all(np.diff(changes) * PERIOD >= KEYS.dwell - 1e-9)


@given(lefts)
@settings(deadline=None)
def test_a_stick_goes_no_further_than_it_does_and_to_no_place_at_once(left):
    pushed = acted(Fingers(STICKS, np.random.default_rng(0)), left)
    assert np.max(np.abs(pushed)) <= 1.0
    assert np.max(np.abs(np.diff(pushed, axis=0))) < 0.5


def test_whoever_is_content_does_nothing():
    for handling in (KEYS, STICKS):
        assert not acted(Fingers(handling, np.random.default_rng(0)), [CONTENT / 2] * 20).any()


def test_a_cap_goes_a_little_astray_and_each_persons_in_their_own_way():
    cap = Handling(RATE, DECAY, CONTENT, FULL, graded=True, idle=0.08, crosstalk=0.1)
    forward = np.array([0.2, 0.0, 0.0, 0.0, 0.0, 0.0])
    (*_, one), (*_, other) = (acted(Fingers(cap, np.random.default_rng(seed)), [forward] * 40) for seed in (0, 1))
    assert 0.0 < np.max(np.abs(one[1:])) < 0.4
    assert not np.allclose(one[1:], other[1:])


def test_what_was_pushed_and_not_seen_yet_is_known():
    """A second of pushing at a tenth of a metre a second: nothing is expected of what came before the look."""
    fingers = Fingers(KEYS, np.random.default_rng(0))
    left = np.array([0.5, 0.0, 0.0, 0.0, 0.0, 0.0])
    acted(fingers, [left] * 51)
    expected = fingers.expected(np.zeros(6), 0.5, decays=True)
    np.testing.assert_allclose(expected, [0.5 * RATE[0], 0.0, 0.0, 0.0, 0.0, 0.0], atol=2 * PERIOD * RATE[0])


def test_what_is_let_go_is_expected_to_return_to_nothing_and_no_further():
    fingers = Fingers(KEYS, np.random.default_rng(0))
    acted(fingers, [np.zeros(6)] * 51)
    before = np.array([0.1, -0.01, 0.0, 0.0, 0.0, 0.0])
    after = fingers.expected(before, 0.5, decays=True)
    np.testing.assert_allclose(after[:2], [0.1 - 0.5 * DECAY[0], 0.0], atol=2 * PERIOD * DECAY[0])
    np.testing.assert_array_equal(fingers.expected(before, 0.5, decays=False), before)


@given(lefts)
@settings(deadline=None)
def test_a_wheel_rolls_by_whole_notches_and_a_pen_drags_only_while_it_is_down(left):
    pen = Pen(PAD)
    dragged = [pen.act(PERIOD * number, one) for number, one in enumerate(left)]
    far = np.array([one.far for one in dragged])
    notches = far[:, [0, 3]] / [PAD.notch, PAD.turn_notch]
    np.testing.assert_allclose(notches, np.round(notches), atol=1e-9)
    for before, after in itertools.pairwise(dragged):
        assert before.down or np.array_equal(before.far, after.far)


def test_where_the_desk_ends_the_pen_is_lifted_and_comes_down_again():
    pen = Pen(PAD)
    down = [pen.act(PERIOD * number, np.array([0.0, 1.0, 0.0, 0.0, 0.0, 0.0])).down for number in range(200)]
    lifted = np.flatnonzero(np.diff(np.array(down, dtype=int)) < 0)
    assert lifted.size >= 1
    assert any(down[lifted[0] + 1 :])


def test_nobody_pushes_and_turns_with_one_pen_at_once():
    pen = Pen(PAD)
    far = np.array([pen.act(PERIOD * n, np.array([0.0, 0.1, 0.0, 0.0, 0.0, 0.4])).far for n in range(30)])
    assert far[-1][1] > 0.0
    assert far[-1][5] == 0.0
