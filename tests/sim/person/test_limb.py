import numpy as np
import pytest

from sim.person.limb import DELAY, Ability, Limb

DT = 0.01
STILL = Ability(speed=0.5, push=0.1, tremor=0.0)
NO_ERROR = np.zeros(3)


def limb(ability=STILL, seed=0):
    return Limb(ability, np.random.default_rng(seed))


def test_it_arrives_critically_damped_as_the_closed_form_says():
    """x = 1 - (1 + w t) exp(-w t) of the way, where the speed does not bind: no overshoot."""
    goal, moving, w = np.array([0.02, 0.0, -0.01]), limb(), 2.0 / DELAY
    for tick in range(1, 101):
        moving.move(goal, NO_ERROR, DT)
        share = 1.0 - (1.0 + w * tick * DT) * np.exp(-w * tick * DT)
        np.testing.assert_allclose(moving.position, share * goal, atol=1e-12)


def test_it_is_no_faster_than_it_can_be():
    moving, speeds = limb(), []
    for _ in range(200):
        before = moving.position
        moving.move(np.array([3.0, 0.0, 4.0]), NO_ERROR, DT)
        speeds.append(np.linalg.norm(moving.position - before) / DT)
    assert max(speeds) == pytest.approx(STILL.speed)


def test_behind_a_goal_that_moves_evenly_it_is_by_its_delay():
    moving, speed = limb(), np.array([0.1, 0.0, 0.0])
    for tick in range(1, 500):
        moving.move(speed * tick * DT, NO_ERROR, DT)
    np.testing.assert_allclose(moving.position, speed * (499 * DT - DELAY), atol=1e-3)


def test_a_lasting_error_is_pushed_away_up_to_a_bound():
    moving = limb()
    for _ in range(2000):
        moving.move(np.zeros(3), np.array([0.0, 0.2, 0.0]), DT)
    np.testing.assert_allclose(moving.position, [0.0, STILL.push, 0.0], atol=1e-9)


def test_at_rest_it_trembles_as_much_as_it_is_said_to():
    trembling = limb(Ability(speed=10.0, push=0.1, tremor=0.01))
    rest = []
    for _ in range(20_000):
        trembling.move(np.zeros(3), NO_ERROR, DT)
        rest.append(trembling.position)
    # Of an Ornstein-Uhlenbeck process of correlation time T = 0.4 s a critically damped follower lets the share
    # (1 + a / 2) / (1 + a)^2 of the variance through, a = 1 / (w T): the integral of the two autocorrelations.
    a = DELAY / 2.0 / 0.4
    assert np.std(rest) == pytest.approx(0.01 * np.sqrt((1.0 + 0.5 * a) / (1.0 + a) ** 2), rel=0.05)
