"""How far a person's motions lie apart, which way they choose, and what of the depth they misjudge."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.interpolation import through
from sim.person.imagination import chosen, departure, imagined
from sim.person.scatter import CAREFUL, USUAL, deviation
from sim.person.sight import Sight
from sim.person.steering import steer
from sim.tasks import DISHWASHER, PARTICLE, POST
from sim.tasks.scene import Corridor, Freedom

SHARES = np.linspace(0.0, 1.0, 101)
PLACE = np.array([0.87, 0.07, 0.553])
FAILING, SAFE = (DISHWASHER.corridor(variant, PLACE) for variant in DISHWASHER.variants)
MIDDLE = np.array([0.885, 0.093, 0.55])  # of the object behind the post, as far from one way's side as from the other's


def motion(way, n=75):
    return through(way.positions, np.linspace(0.0, len(way.positions) - 1.0, n))


def rms(difference):
    return np.sqrt(np.mean(np.sum(difference**2, axis=-1)))


def test_recorded_people_repeat_themselves_as_the_defaults_do():
    assert 0.018 <= CAREFUL < USUAL <= 0.052


@given(scatter=st.floats(0.001, 0.1))
def test_two_motions_are_as_far_apart_as_the_scatter_says(scatter):
    rng = np.random.default_rng(0)
    one, other = (np.array([deviation(SHARES, scatter, rng) for _ in range(400)]) for _ in range(2))
    assert rms(one - other) == pytest.approx(scatter, rel=0.05)


def test_a_deviation_is_smooth_and_nothing_where_the_person_aims():
    drawn = deviation(SHARES, 0.05, np.random.default_rng(1), targets=(0.5,))
    np.testing.assert_allclose(drawn[[0, 50, 100]], 0.0, atol=1e-12)
    assert np.max(np.abs(drawn)) > 0.005
    plain = np.array([deviation(SHARES, 0.05, np.random.default_rng(seed)) for seed in range(50)])
    bends = np.abs(np.diff(plain, 2, axis=1)).max() / (SHARES[1] ** 2)
    assert bends < 9.0 * np.pi**2 * np.abs(plain).max(), "no faster than three half periods over the way"


def test_a_demonstration_scatters_carefully_and_a_steady_hand_not_at_all():
    ways = np.array([steer(SAFE, np.random.default_rng(seed)).positions for seed in range(200)])
    steady = steer(SAFE, None).positions
    np.testing.assert_allclose(ways[:, [0, -1]], np.broadcast_to(steady[[0, -1]], (200, 2, 3)), atol=1e-12)
    apart = ways[0::2] - ways[1::2]
    assert 0.5 * CAREFUL < rms(apart) < 1.5 * CAREFUL


def test_a_way_is_imagined_anew_each_time_and_not_towards_what_is_avoided():
    rng = np.random.default_rng(2)
    failing = motion(FAILING)
    ways = np.array([imagined(SAFE, failing, USUAL, rng, Freedom()).positions for _ in range(300)])
    off = ways - SAFE.positions
    np.testing.assert_allclose(off[:, [0, -1]], 0.0, atol=1e-12)
    assert rms(ways[0::2] - ways[1::2]) < USUAL
    assert rms(off) > 0.5 * USUAL / np.sqrt(2.0)
    away = SAFE.positions - FAILING.positions
    far = np.linalg.norm(away, axis=1) > 0.1
    assert np.any(far)
    towards = np.sum(off[:, far] * away[far] / np.linalg.norm(away[far], axis=1, keepdims=True), axis=-1)
    assert np.mean(towards > -0.3 * USUAL) > 0.95


def test_without_scatter_the_way_is_the_one_that_is_meant():
    meant = imagined(SAFE, motion(FAILING), 0.0, np.random.default_rng(0), Freedom())
    np.testing.assert_array_equal(meant.positions, SAFE.positions)


def test_where_a_person_cannot_deviate_they_do_not():
    way = PARTICLE.corridor("obstacle", np.array([0.1, -0.1]))
    still = motion(PARTICLE.corridor("free", np.zeros(2)), len(way.positions))
    off = imagined(way, still, USUAL, np.random.default_rng(3), PARTICLE.freedom).positions - way.positions
    np.testing.assert_array_equal(off[:, [0, 2]], 0.0)
    assert np.max(np.abs(off[:, 1])) > 0.003
    x = way.positions[:, 0]
    np.testing.assert_allclose(np.interp(PARTICLE.via_x, x, off[:, 1]), 0.0, atol=1e-4)


def sides(ways, predicted, seeds=200):
    return np.array(
        [np.sign(chosen(ways, predicted, np.random.default_rng(s)).positions[3, 1] - 0.05) for s in range(seeds)]
    )


def test_round_the_post_the_seed_chooses_the_side_where_both_are_alike():
    ways = POST.corridors("post", MIDDLE)
    left = np.mean(sides(ways, motion(POST.corridor("clear", MIDDLE))) > 0.0)
    assert 0.3 < left < 0.7


def test_a_motion_that_goes_round_one_side_already_is_corrected_on_that_side():
    ways = POST.corridors("post", MIDDLE)
    for way in ways:
        assert np.all(sides(ways, motion(way), 50) == np.sign(way.positions[3, 1] - 0.05))


def test_the_departure_is_nought_from_the_way_itself_and_as_far_as_it_is_moved():
    assert departure(SAFE, motion(SAFE, 200)) < 1e-3
    moved = Corridor(SAFE.positions + np.array([0.03, 0.0, -0.04]), SAFE.orientations)
    assert departure(moved, motion(SAFE, 200)) == pytest.approx(0.05, abs=1e-3)


def test_depth_is_misjudged_along_the_line_of_sight_and_by_the_same_for_an_episode():
    eye, place = np.array([0.0, -1.0, 1.0]), np.array([0.8, 0.1, 0.5])
    line = (place - eye) / np.linalg.norm(place - eye)
    lasting = []
    for seed in range(300):
        sight = Sight(eye, 0.01, np.random.default_rng(seed))
        errors = np.array([sight.look(place, 0.5) - place for _ in range(40)])
        np.testing.assert_allclose(np.cross(errors, line), 0.0, atol=1e-12)
        assert np.std(errors @ line) < 0.006
        lasting.append(np.mean(errors @ line))
    assert np.std(lasting) == pytest.approx(0.01, rel=0.15)


def test_a_perfect_eye_sees_what_is_there():
    place = np.array([0.8, 0.1, 0.5])
    np.testing.assert_array_equal(Sight(np.zeros(3), 0.0, np.random.default_rng(0)).look(place, 0.1), place)
