import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.models.adaptive.correction import Correction, CorrectionOptions
from lfd.models.adaptive.covariance import CovarianceOptions
from lfd.models.adaptive.kinds import DURATION, ORIENTATION, POSITION
from lfd.models.adaptive.regression import Regression, RegressionOptions
from lfd.models.adaptive.scale import ConditionScale
from lfd.models.model import ONLY_WAY
from tests.lfd.models.adaptive.vectors import KINDS, D, correct, corrections, effect, regression, sized

OPTIONS = CorrectionOptions()
HERE = np.array([0.05, 0.1])


def change(held, s):
    return effect(held, s).change


def test_without_a_correction_nothing_changes_and_everything_is_open(none):
    untouched = effect(none, HERE)
    np.testing.assert_array_equal(untouched.change, np.zeros(D))
    assert (untouched.open_share, untouched.surprise, untouched.evidence, untouched.way) == (1.0, 0.0, 1.0, ONLY_WAY)


@pytest.mark.parametrize("size", [0.001, 0.01, 0.3])
def test_at_its_own_condition_one_correction_counts_for_all_but_its_noise(none, size, rng):
    """C / (C + noise C), whatever C is, and so large or small a correction, in each kind of output."""
    y = sum(sized(kind, size, rng) for kind in range(3))
    corrected = correct(none, HERE, y)
    np.testing.assert_allclose(change(corrected, HERE), y / (1.0 + OPTIONS.noise), rtol=1e-9)
    assert effect(corrected, HERE).open_share == pytest.approx(OPTIONS.noise / (1.0 + OPTIONS.noise), rel=1e-6)


@pytest.mark.parametrize("kind", [POSITION, ORIENTATION, DURATION])
def test_a_correction_of_one_kind_changes_no_other(none, kind):
    corrected = correct(correct(none, HERE, sized(kind, 0.4)), [-0.1, 0.0], sized(kind, -0.2))
    others = np.setdiff1d(np.arange(D), KINDS.columns[kind])
    for s in (HERE, [0.3, -0.3], [2.0, 2.0]):
        np.testing.assert_allclose(change(corrected, s)[others], 0.0, atol=1e-12)


@pytest.mark.parametrize("kind", [POSITION, ORIENTATION, DURATION])
@pytest.mark.parametrize("distance", [0.1, 0.5, 2.0])
def test_a_great_surprise_fades_as_the_matern_kernel_of_its_kind_s_reach(taught, kind, distance):
    """Beside it, what the demonstrations left open is nothing: the surprise of one kind is its own."""
    options = CovarianceOptions(reach=(1.0, 2.0, 3.0))
    corrected = correct(corrections(taught, covariance=options), HERE, sized(kind, 1e5))
    r = np.sqrt(3.0) * distance / (kind + 1.0)
    expected = sized(kind, 1e5) * (1.0 + r) * np.exp(-r) / (1.0 + OPTIONS.noise)
    away = HERE + distance * np.array([0.6, 0.8])
    np.testing.assert_allclose(change(corrected, away), expected, rtol=1e-5, atol=1e-6)


def values(*entries):
    """A change of positions by weights that are these along the three axes."""
    return np.append(np.tile([*entries, 0.0, 0.0, 0.0], 3), 0.0)


@pytest.mark.parametrize("y", [(0.3, 0.02, 0.0), (0.02, -0.2, 0.05)], ids=["to a side", "down"])
def test_a_correction_is_carried_on_as_far_as_it_is_larger_than_motions_differ_anyway(none, y):
    """Where the world is as changed as there: what the filter keeps, and at its own place all of it."""
    options = CovarianceOptions(value_std=0.05, near_std=1e-4, near=1e-3, reach=(1e6,) * 3)
    corrected = correct(corrections(none.regression, covariance=options), HERE, values(*y))
    kept = KINDS.filtered(values(*y)[None], np.full(3, 0.05**2))[0]
    np.testing.assert_allclose(change(corrected, HERE) * (1.0 + OPTIONS.noise), values(*y), rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(change(corrected, HERE + 0.5) * (1.0 + OPTIONS.noise), kept, rtol=1e-4, atol=1e-7)


def test_halfway_between_two_corrections_that_agree_nothing_of_them_is_a_detail():
    """A centimetre to a side, as both say, beside forty upwards; of one alone the rest of it stays at its place."""
    y = values(0.01, 0.0, 0.4)
    one = correct(corrections(regression([[0.0, 0.0]], np.zeros((1, D)))), [-0.2, 0.0], y)
    both = correct(one, [0.2, 0.0], y)
    at_one, halfway = (KINDS.paths(change(held, [0.0, 0.0])[None])[0, 10] for held in (one, both))
    assert halfway[0] / halfway[2] == pytest.approx(0.01 / 0.4, rel=1e-6)
    assert at_one[0] / at_one[2] < 0.8 * 0.01 / 0.4


def test_nothing_is_a_detail_where_motions_that_are_meant_alike_are_alike(none):
    options = CovarianceOptions(value_std=1e-9, near_std=1e-4, near=1e-3, reach=(1e6,) * 3)
    y = values(0.3, 0.001, 0.0)
    corrected = correct(corrections(none.regression, covariance=options), HERE, y)
    np.testing.assert_allclose(change(corrected, HERE + 0.5) * (1.0 + OPTIONS.noise), y, rtol=1e-4, atol=1e-9)


@given(st.integers(0, 2**32 - 1))
def test_what_is_carried_on_is_in_no_kind_larger_than_the_correction(seed):
    """Although the values of a wild one cancel each other in the motion."""
    rng = np.random.default_rng(seed)
    regression_of_none = regression([[0.0, 0.0]], np.zeros((1, D)))
    options = CovarianceOptions(reach=(1e6,) * 3)
    y = rng.normal(size=D) * 10.0 ** rng.uniform(-3.0, 0.0)
    corrected = correct(corrections(regression_of_none, covariance=options), HERE, y)
    sizes = KINDS.sizes(np.array([change(corrected, HERE + rng.normal(size=2)), y]))
    assert (sizes[:, 0] <= sizes[:, 1] * (1.0 + 1e-9)).all()


def test_the_newest_correction_of_a_condition_wins_if_they_tell_of_other_worlds(none):
    corrected = none
    for y in (0.3, -0.2, 0.1):
        corrected = correct(corrected, HERE, sized(POSITION, y))
    np.testing.assert_allclose(change(corrected, HERE), sized(POSITION, 0.1), atol=0.01)
    assert effect(corrected, HERE).evidence == pytest.approx(1.0)


def test_corrections_that_agree_are_averaged_and_all_count(none):
    corrected = none
    for y in (0.20, 0.21, 0.19, 0.205, 0.195):
        corrected = correct(corrected, HERE, sized(POSITION, y))
    np.testing.assert_allclose(change(corrected, HERE), sized(POSITION, 0.2), rtol=0.01, atol=1e-12)
    assert effect(corrected, HERE).evidence == pytest.approx(5.0, rel=0.01)


def test_the_evidence_is_one_where_no_correction_speaks_for_positions(none):
    assert effect(correct(none, HERE, sized(DURATION, 0.3)), HERE).evidence == 1.0
    assert effect(correct(none, HERE, sized(POSITION, 0.3)), [1e6, 0.0]).evidence == 1.0


@pytest.mark.parametrize("K", [2, 5])
def test_corrections_that_repeat_each_other_scatter_by_the_noise_that_was_learnt(none, K):
    """K corrections y at one place: y K C / (K C + r C + sigma^2), where C is y^2; a single one knows no sigma."""
    corrected = none
    for _ in range(K):
        corrected = correct(corrected, HERE, sized(POSITION, 0.05))
    C, sigma = 0.05**2, OPTIONS.world.noise
    share = K * C / (K * C + OPTIONS.noise * C + sigma**2)
    np.testing.assert_allclose(change(corrected, HERE), share * sized(POSITION, 0.05), rtol=1e-9, atol=1e-12)
    assert effect(corrected, HERE).open_share == pytest.approx(1.0 - share, rel=1e-6)


def test_each_kind_tells_noise_from_change_by_itself(none):
    """The way is the same, the duration has changed."""
    corrected = none
    for y, slower in ((0.20, 0.0), (0.21, 0.0), (0.19, 1.0)):
        corrected = correct(corrected, HERE, sized(POSITION, y) + sized(DURATION, slower))
    changed = change(corrected, HERE)
    np.testing.assert_allclose(changed[KINDS.columns[POSITION]], sized(POSITION, 0.2)[KINDS.columns[POSITION]], 0.02)
    assert changed[-1] == pytest.approx(1.0, rel=0.01)


def scattered(rng, K, sigma=0.03):
    """Corrections of one world: 15 cm to a side, give or take in all three directions."""
    offset = np.zeros((3, 6))
    changes = []
    for _ in range(K):
        offset[:, :3] = rng.normal(size=3) * sigma / np.sqrt(3.0)
        flat = np.append(offset.ravel(), 0.0)
        changes.append(sized(POSITION, 0.15) + flat * (1.0 / sized(POSITION, 1.0)[0] / np.sqrt(3.0)))
    return changes


@pytest.mark.parametrize("K", [2, 3, 6, 12])
def test_noisy_corrections_of_one_world_approach_their_mean_and_a_change_is_followed_at_once(taught, K):
    """Scattering by 3 cm, of motions 60 cm long."""
    missed, mean_missed = [], []
    for seed in range(12):
        changes = scattered(np.random.default_rng(seed), K)
        held = corrections(taught, extent=0.6)
        for y in changes:
            held = correct(held, HERE, y)
        now = change(held, HERE)
        missed.append(KINDS.sizes((now - sized(POSITION, 0.15))[None])[POSITION, 0])
        mean_missed.append(KINDS.sizes((np.mean(changes, axis=0) - sized(POSITION, 0.15))[None])[POSITION, 0])
        opposite = sized(POSITION, -0.15)
        left = change(correct(held, HERE, opposite), HERE) - opposite
        gap = now - opposite
        assert KINDS.sizes(left[None])[POSITION, 0] <= 0.04**2 * KINDS.sizes(gap[None])[POSITION, 0]
    assert np.sqrt(np.mean(missed) / np.mean(mean_missed)) <= 1.3


def test_corrections_apart_are_all_kept(none):
    told = {(-0.8, 0.0): 0.3, (0.0, 0.0): -0.2, (0.8, 0.0): 0.1}
    corrected = none
    for s, y in told.items():
        corrected = correct(corrected, s, sized(POSITION, y))
    for s, y in told.items():
        np.testing.assert_allclose(change(corrected, s), sized(POSITION, y), atol=0.02)


@given(st.integers(1, 6), st.integers(0, 2**32 - 1), st.sampled_from([POSITION, ORIENTATION, DURATION]))
def test_together_corrections_do_no_more_than_the_nearest_could_alone(J, seed, kind):
    """So nowhere is a change larger than the largest that was taught, in any number of it, and it fades as one does."""
    rng = np.random.default_rng(seed)
    conditions = rng.uniform(-0.3, 0.3, size=(int(rng.integers(1, 5)), 2))
    held = corrections(regression(conditions, rng.normal(size=(len(conditions), D))))
    for s in rng.uniform(-0.5, 0.5, size=(J, 2)):
        held = correct(held, s, sized(kind, 10.0 ** rng.uniform(-2.0, 1.0) * rng.choice([-1.0, 1.0])))
    most = KINDS.sizes(held.changes).max(axis=1)
    for s in [*rng.uniform(-1.0, 1.0, size=(5, 2)), *rng.uniform(-10.0, 10.0, size=(5, 2))]:
        nearest = min(np.linalg.norm(c.s - s) for c in held.held)
        r = np.sqrt(3.0) * nearest / OPTIONS.covariance.reach[kind]
        size = KINDS.sizes(change(held, s)[None])[:, 0]
        assert (size <= most * ((1.0 + r) * np.exp(-r) * (1.0 + 1e-9)) ** 2 + 1e-12).all()


def sequence(rng, count):
    """Corrections at a few conditions, some again and again."""
    places = rng.uniform(-0.3, 0.3, size=(4, 2))
    return [(places[rng.integers(4)], sized(POSITION, 0.3, rng)) for _ in range(count)]


@given(st.integers(1, 5), st.integers(1, 14), st.integers(0, 2**32 - 1))
def test_taking_back_as_many_as_fit_is_exact_also_where_there_was_no_room(most, added, seed):
    rng = np.random.default_rng(seed)
    states = [corrections(regression(rng.normal(size=(3, 2)), rng.normal(size=(3, D))), most=most)]
    for s, y in sequence(rng, added):
        states.append(states[-1].added(Correction(s, y)))
    held = states[-1]
    for before in states[-2 : -min(most, added) - 2 : -1]:
        held = held.taken_back()
        assert [id(c) for c in held.held] == [id(c) for c in before.held]
        np.testing.assert_allclose(change(held, HERE), change(before, HERE), atol=1e-12)


def test_memory_is_bounded(none, rng):
    held = corrections(none.regression, most=3)
    for s, y in sequence(rng, 20):
        held = correct(held, s, y)
        assert len(held) <= 3
        assert len(held.aside) <= 3


def test_the_most_outdated_is_set_aside_first(none):
    held = corrections(none.regression, most=2)
    for s, y in (([1.0, 0.0], 0.1), ([0.0, 0.0], 0.2), ([0.0, 0.0], 0.3)):
        held = correct(held, s, sized(POSITION, y))
    np.testing.assert_allclose(change(held, [1.0, 0.0]), sized(POSITION, 0.1), atol=0.01)
    np.testing.assert_allclose(change(held, [0.0, 0.0]), sized(POSITION, 0.3), atol=0.01)


def test_of_what_still_holds_that_which_has_the_most_newer_ones_beside_it_is_set_aside(none):
    held = corrections(none.regression, most=4)
    for i, s in enumerate([[1.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [1.0, 0.0]]):
        held = correct(held, s, sized(POSITION, 0.1 + 0.001 * i))
    assert [index for index, _ in held.aside] == [1]


def test_what_no_longer_holds_is_set_aside_before_what_does(none):
    """An opposite one at a condition outdates all before it there; three that agree elsewhere still hold."""
    held = corrections(none.regression, most=5)
    told = [([0.0, 0.0], 0.1), ([0.0, 0.0], 0.1), ([0.0, 0.0], 0.1), ([2.0, 0.0], 0.2), ([2.0, 0.0], -0.2)]
    for s, y in [*told, ([4.0, 0.0], 0.1)]:
        held = correct(held, s, sized(POSITION, y))
    assert [index for index, _ in held.aside] == [3]


def test_at_its_half_life_a_correction_counts_half(none):
    """A newer one far away tells its age; C / (C + C (noise + 2^1 - 1))."""
    held = corrections(none.regression, half_life_s=100.0)
    held = correct(held, HERE, sized(POSITION, 0.3), at_s=1000.0)
    for age, share in ((0.0, 1.0), (100.0, 0.5), (200.0, 0.25)):
        aged = correct(held, [1e3, 0.0], sized(POSITION, 0.3), at_s=1000.0 + age)
        expected = sized(POSITION, 0.3) / (1.0 / share + OPTIONS.noise)
        np.testing.assert_allclose(change(aged, HERE), expected, rtol=1e-6, atol=1e-12)


def test_after_many_half_lives_nothing_is_left_and_nothing_overflows(none):
    held = correct(corrections(none.regression, half_life_s=1e-3), HERE, sized(POSITION, 0.3), at_s=0.0)
    held = correct(held, [1e3, 0.0], sized(POSITION, 0.3), at_s=1e9)
    np.testing.assert_allclose(change(held, HERE), 0.0, atol=1e-12)


def test_a_correction_of_unknown_time_is_as_new_as_the_newest_and_none_ages_without_times(none):
    for times in ((None, None), (None, 1e9)):
        held = correct(corrections(none.regression, half_life_s=1.0), HERE, sized(POSITION, 0.3), times[0])
        held = correct(held, [1e3, 0.0], sized(POSITION, 0.3), times[1])
        np.testing.assert_allclose(
            change(held, HERE), sized(POSITION, 0.3) / (1.0 + OPTIONS.noise), rtol=1e-6, atol=1e-12
        )


def test_unless_asked_nothing_ages(none):
    held = correct(none, HERE, sized(POSITION, 0.3), at_s=0.0)
    held = correct(held, [1e3, 0.0], sized(POSITION, 0.3), at_s=1e9)
    np.testing.assert_allclose(change(held, HERE), sized(POSITION, 0.3) / (1.0 + OPTIONS.noise), rtol=1e-6, atol=1e-12)


def test_the_mean_square_is_that_of_the_positions(none):
    held = correct(correct(none, HERE, sized(POSITION, 0.3)), [-0.2, 0.0], sized(POSITION, 0.1))
    assert held.mean_square == pytest.approx((0.09 + 0.01) / 2.0)


def test_a_dimension_that_never_varied_gets_its_unit_from_a_correction(rng):
    """Far along it, the correction counts less."""
    conditions = np.column_stack([rng.normal(size=5), np.full(5, 3.0)])
    scale = ConditionScale.of_conditions(conditions, np.zeros(2), np.full(2, -1))
    fitted = Regression(scale, conditions, rng.normal(size=(5, D)), KINDS, RegressionOptions())
    held = correct(corrections(fitted), [0.0, 4.0], sized(POSITION, 0.3))
    shares = [np.abs(change(held, [0.0, size])).max() for size in (4.0, 3.0, 9.0, 300.0)]
    assert (np.diff(shares[:2]) < 0.0).all()
    assert shares[2] < shares[0]
    assert shares[3] < 1e-6 * shares[0]
