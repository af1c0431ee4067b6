"""A motion needs of a detour what it does not have by itself, by the shorter way round."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.models.adaptive.detour import Detours
from lfd.models.encoding import OUTPUTS

P, N = 25, 6
SIZE = 0.1  # of the detour at its middle [m]
BUMP = np.sin(np.pi * np.linspace(0.0, 1.0, P))
WAY = np.column_stack([np.linspace(0.0, 0.4, P), np.zeros(P), np.full(P, 0.2)])
LEFT = np.outer(SIZE * BUMP, [0.0, 1.0, 0.0])

sides = st.floats(-3.0, 3.0)


def detours(*changes, paths=(WAY,), scatter=1e-4):
    return Detours.of(paths, np.array(changes), scatter)


def beside(share, direction=(0.0, 1.0, 0.0)):
    """A way that passes so much of the detour's size beside the one that was corrected."""
    return WAY + share * SIZE * np.outer(BUMP, direction)


def vector(outputs):
    """Of weights that say the same everywhere: outputs (6,), and a change of the duration."""
    return np.append(np.tile(outputs, N), 0.3)


def weights(vectors):
    """The view of them that `Kinds.weights` gives."""
    return vectors[:, :-1].reshape(len(vectors), N, OUTPUTS)


def change(needed, outputs):
    """What is made of that vector: its outputs (6,) and the change of the duration."""
    made = needed.of(vector(outputs)[None], weights)[0]
    return made[:OUTPUTS], made[-1]


def test_where_the_same_way_would_be_gone_all_of_it_is_needed():
    needed = detours(LEFT).needed(WAY)
    np.testing.assert_array_equal(needed.of(vector(np.ones(6))[None], weights)[0], vector(np.ones(6)))


@given(st.floats(0.0, 1.0))
def test_as_much_less_as_the_motion_goes_that_way_by_itself(share):
    outputs, duration = change(detours(LEFT).needed(beside(share)), np.arange(1.0, 7.0))
    np.testing.assert_allclose(outputs, (1.0 - share) * np.arange(1.0, 7.0), atol=1e-5)
    assert duration == pytest.approx((1.0 - share) * 0.3, abs=1e-5)


@given(st.floats(-1.0, -0.251))
def test_on_the_other_side_the_mirror_image_of_what_is_missing_there(share):
    outputs, duration = change(detours(LEFT).needed(beside(share)), np.arange(1.0, 7.0))
    np.testing.assert_allclose(outputs, (1.0 + share) * np.array([1.0, -2.0, 3.0, 4.0, 5.0, 6.0]), atol=1e-4)
    assert duration == pytest.approx((1.0 + share) * 0.3, abs=1e-4)


@given(st.one_of(st.floats(1.0, 9.0), st.floats(-9.0, -1.0)))
def test_a_motion_that_has_the_room_already_needs_nothing(share):
    outputs, duration = change(detours(LEFT).needed(beside(share)), np.ones(6))
    np.testing.assert_allclose(outputs, 0.0, atol=1e-5)
    assert duration == pytest.approx(0.0, abs=1e-5)


@given(sides)
def test_every_motion_passes_with_three_quarters_of_the_room_that_the_correction_made(share):
    outputs, _ = change(detours(LEFT).needed(beside(share)), [0.0, SIZE, 0.0, 0.0, 0.0, 0.0])
    assert abs(share * SIZE + outputs[1]) >= 0.75 * SIZE - 1e-6


@given(sides)
def test_what_lies_across_the_detour_does_not_matter(share):
    needed = detours(LEFT).needed(beside(share, (0.6, 0.0, 0.8)))
    np.testing.assert_array_equal(needed.of(vector(np.ones(6))[None], weights)[0], vector(np.ones(6)))


@given(sides, st.integers(0, 2**32 - 1))
def test_nothing_becomes_larger_than_it_was(share, seed):
    rng = np.random.default_rng(seed)
    needed = detours(rng.normal(size=(P, 3)), scatter=0.1).needed(WAY + share * rng.normal(size=(P, 3)))
    outputs = rng.normal(size=6)
    made, _ = change(needed, outputs)
    assert np.linalg.norm(made[:3]) <= np.linalg.norm(outputs[:3]) + 1e-12
    assert np.linalg.norm(made[3:]) <= np.linalg.norm(outputs[3:]) + 1e-12


@given(sides)
def test_where_the_hand_arrives_goes_with_the_object(share):
    """A change that grows towards the end of the motion is no detour: a seventh at most is taken for one."""
    offset = np.outer(SIZE * np.linspace(0.0, 1.0, P), [0.0, 1.0, 0.0])
    outputs, _ = change(detours(offset).needed(beside(share)), [0.0, 1.0, 0.0, 0.0, 0.0, 0.0])
    assert outputs[1] >= 1.0 - 2.0 / 7.0


@given(sides)
def test_what_is_no_larger_than_motions_differ_is_no_detour(share):
    outputs, _ = change(detours(LEFT, scatter=3.0 * SIZE).needed(beside(share)), np.ones(6))
    np.testing.assert_allclose(outputs, 1.0, atol=0.01)


def test_how_far_a_change_is_a_detour_goes_by_the_squares_of_what_it_is_and_is_not():
    """Its mean square against its square at the end and that of the scatter."""
    bent, scatter = LEFT + np.outer(np.linspace(0.0, 0.7 * SIZE, P), [0.0, 1.0, 0.0]), 0.9 * SIZE
    size, rest = np.mean(bent[:, 1] ** 2), bent[-1, 1] ** 2 + scatter**2
    _, duration = change(detours(bent, scatter=scatter).needed(WAY + bent), np.ones(6))
    assert duration == pytest.approx(0.3 * rest**2 / (size**2 + rest**2))


@given(st.floats(-0.9, -0.3), sides)
def test_once_a_correction_led_to_the_farther_side_too_nothing_is_assumed(first, share):
    """As over a wall: the second led to the same side from where the other side would have been nearer."""
    over = detours(LEFT, (1.0 - first) * LEFT, paths=(WAY, beside(first))).needed(beside(share))
    np.testing.assert_array_equal(over.shares, 1.0)
    assert over.mirrored == ()


def test_a_correction_to_the_nearer_side_bears_the_assumption_out():
    round_it = detours(LEFT, -0.5 * LEFT, paths=(WAY, beside(-0.5))).needed(beside(-0.6))
    assert [j for j, _ in round_it.mirrored] == [0]
    assert round_it.shares[0] == pytest.approx(0.4)


@given(st.floats(-9.0, 0.0))
def test_where_both_ways_round_were_shown_none_is_made_up(share):
    needed = detours(LEFT).needed(beside(share), shown=True)
    np.testing.assert_allclose(needed.of(vector(np.ones(6))[None], weights)[0], vector(np.ones(6)))


@pytest.mark.parametrize("oblique", [0.1, 0.2])
def test_a_detour_that_leads_a_little_aside_is_none_round_what_stands_there(oblique):
    """People do not steer straight: to a motion far aside as much is done as to one beside it."""
    needed = detours(LEFT + np.outer(SIZE * BUMP, [0.0, 0.0, oblique])).needed(beside(2.0, (0.0, 0.0, 1.0)))
    assert change(needed, np.ones(6))[1] > 0.99 * 0.3


def test_where_a_way_is_not_known_all_is_needed_beside_others_of_which_it_is():
    needed = detours(LEFT, LEFT, paths=(None, WAY)).needed(beside(1.0))
    np.testing.assert_allclose(needed.of(np.array([vector(np.ones(6))] * 2), weights)[:, 0], [1.0, 0.0], atol=1e-5)


def test_a_correction_that_changed_no_position_is_needed_everywhere():
    needed = detours(np.zeros((P, 3))).needed(beside(1.0))
    np.testing.assert_array_equal(needed.of(vector(np.ones(6))[None], weights)[0], vector(np.ones(6)))
