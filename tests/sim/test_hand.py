import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from sim.correction import plan
from sim.hand import DAMPING, REACTION, SPEED, STIFFNESS, Hand, Seen
from sim.scenes import DISHWASHER, REACHING
from sim.stylus import Stylus, StylusState

FEEDBACK = 50.0  # [N/m] of equation (14)
FEEDBACK_DAMPING = 2.0  # [N s/m]
PERIOD = 0.01
OBJECT = {"dishwasher": np.array([0.87, 0.07, 0.553]), "table": np.array([0.70, 0.10, 0.71])}


def ways(name):
    scene = REACHING[name]
    return [scene.corridor(variant, OBJECT[name]).positions for variant in scene.variants]


def predicted(way, n=75):
    """What a robot would do that learnt the way: at rest at both ends, smooth between."""
    s = np.linspace(0.0, 1.0, n)
    share = s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
    line = PchipInterpolator(np.arange(len(way)), way)(np.linspace(0.0, len(way) - 1.0, 500))
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    return np.column_stack([np.interp(share, lengths / lengths[-1], column) for column in line.T])


def with_feedback(push, state):
    axes = zip(push, state.position, state.velocity, strict=True)
    return tuple(f - FEEDBACK * x - FEEDBACK_DAMPING * v for f, x, v in axes)


class Episode:
    """A robot that follows the stylus as equation (16) says, and a hand that looks at it."""

    def __init__(self, correction, hand, duration=20.0, offset=(0.0, 0.0, 0.0)):
        self.correction, self.hand, self.duration = correction, hand, duration
        self.look_ahead = duration / 74
        self.stylus = Stylus()
        self.offset = np.array(offset)
        self.progress = 0.0
        self.time = 0.0
        hand.grip(correction, self.stylus.state)

    @property
    def robot(self):
        nominal = self.correction.position(self.progress) - self.correction.displacement(self.progress)
        return nominal + self.offset

    def step(self, moving=True):
        seen = Seen(self.progress, self.robot, self.offset.copy(), np.array(self.stylus.state.position))
        target = self.hand.observe(self.time, seen)
        for _ in range(10):
            state = self.stylus.state
            self.stylus.step(with_feedback(self.hand.force(state), state), PERIOD / 10)
        if moving and self.hand.clutched:
            self.progress = min(1.0, self.progress + PERIOD / self.duration)
            self.offset = self.offset + PERIOD / self.look_ahead * (np.array(self.stylus.state.position) - self.offset)
        self.time += PERIOD
        return target


def test_the_spring_of_the_feedback_pulls_the_stylus_short_of_the_target():
    """Steady state of two springs against each other: x = K_h / (K_h + k) target."""
    correction = plan(*[predicted(ways("table")[0])] * 2, [predicted(ways("table")[0])])
    hand = Hand(seed=0)
    hand.grip(correction, StylusState(position=(0.1, -0.05, 0.02)))
    stylus = Stylus()
    for _ in range(2000):
        stylus.step(with_feedback(hand.force(stylus.state), stylus.state), 1e-3)
    expected = STIFFNESS / (STIFFNESS + FEEDBACK) * np.array([0.1, -0.05, 0.02])
    np.testing.assert_allclose(stylus.state.position, expected, atol=1e-6)


def test_the_hand_is_an_impedance_and_nothing_when_off():
    hand = Hand(seed=0)
    state = StylusState(position=(0.0, 0.0, 0.0), velocity=(0.1, 0.0, -0.1))
    assert hand.force(state) == (0.0, 0.0, 0.0)
    assert hand.observe(0.0, Seen(0.0, np.zeros(3), np.zeros(3), np.zeros(3))) is None
    hand.grip(plan(*[ways("table")[0]] * 2, [ways("table")[0]]), state)
    assert hand.force(state) == pytest.approx((-0.1 * DAMPING, 0.0, 0.1 * DAMPING))
    hand.release()
    assert hand.force(state) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("name", REACHING)
def test_the_way_that_is_safe_is_left_alone(name):
    _, safe = ways(name)
    correction = plan(predicted(safe), safe, ways(name))
    assert np.max(np.abs(correction.displacements)) < 1e-3


@pytest.mark.parametrize("name", REACHING)
def test_a_recognised_way_is_moved_way_point_by_way_point(name):
    learnt, safe = ways(name)
    prediction = predicted(learnt)
    correction = plan(prediction, safe, ways(name))
    for before, after in zip(learnt, safe, strict=True):
        passed = np.argmin(np.linalg.norm(prediction - before, axis=1))
        moved = correction.position(passed / (len(prediction) - 1))
        np.testing.assert_allclose(moved, after, atol=0.02)


def test_exaggeration_multiplies_the_correction():
    learnt, safe = ways("dishwasher")
    natural = plan(predicted(learnt), safe, [learnt, safe])
    double = plan(predicted(learnt), safe, [learnt, safe], exaggeration=2.0)
    np.testing.assert_allclose(double.displacements, 2.0 * natural.displacements)


@pytest.mark.sim
@pytest.mark.parametrize("name", REACHING)
def test_the_robot_ends_up_on_the_safe_way_and_at_the_object(name):
    """A prediction that goes wrong by more than 0.1 m and ends 0.03 m beside the object is put right."""
    learnt, safe = ways(name)
    wrong = predicted(learnt) + np.linspace(0.0, 0.03, 75)[:, np.newaxis] * np.array([0.0, 1.0, 0.0])
    correction = plan(wrong, safe, [learnt, safe])
    assert np.max(np.linalg.norm(correction.displacements, axis=1)) > 0.1
    episode = Episode(correction, Hand(seed=3))
    errors = []
    while episode.progress < 1.0:
        episode.step()
        errors.append(np.linalg.norm(episode.robot - correction.position(episode.progress)))
    assert max(errors) < 0.015
    assert np.linalg.norm(episode.robot - safe[-1]) < 0.01


@pytest.mark.sim
def test_the_hand_keeps_to_human_speed_and_trembles_little():
    learnt, safe = ways("dishwasher")
    correction = plan(predicted(learnt), safe, [learnt, safe])
    episode = Episode(correction, Hand(seed=1), duration=5.0)
    targets = []
    while episode.progress < 1.0:
        targets.append(episode.step())
    assert np.max(np.linalg.norm(np.diff(targets, axis=0), axis=1)) <= SPEED * PERIOD * (1.0 + 1e-9)

    alone = plan(safe, safe, [safe])
    still = Episode(alone, Hand(seed=1))
    rest = np.array([still.step(moving=False) for _ in range(1000)])
    assert 0.0005 < np.std(rest) < 0.002


def test_a_seed_makes_a_hand():
    learnt, safe = ways("table")
    correction = plan(predicted(learnt), safe, [learnt, safe])

    def moved(seed):
        episode = Episode(correction, Hand(seed))
        return np.array([episode.step() for _ in range(200)])

    np.testing.assert_array_equal(moved(4), moved(4))
    assert not np.array_equal(moved(4), moved(5))


def test_surprises_are_acted_on_after_the_reaction_time_only():
    """Two robots, one of which is pushed aside: the hand does the same until a reaction time has passed."""
    safe = DISHWASHER.corridor("b1", OBJECT["dishwasher"]).positions
    correction = plan(predicted(safe), safe, [safe])
    quiet, pushed = Episode(correction, Hand(seed=2)), Episode(correction, Hand(seed=2))
    for _ in range(100):
        quiet.step()
        pushed.step()
    pushed.offset = pushed.offset + 0.03
    before = round(REACTION / PERIOD)
    for _ in range(before):
        np.testing.assert_array_equal(quiet.step(), pushed.step())
        pushed.offset = np.maximum(pushed.offset, 0.03)
    for _ in range(before):
        quiet_target, pushed_target = quiet.step(), pushed.step()
    assert np.all(np.array(pushed_target) < np.array(quiet_target))


@pytest.mark.sim
def test_coming_back_in_the_middle_the_clutch_closes_where_the_robot_stands():
    """A new stylus starts at zero while the robot holds a correction: it takes over without a jump."""
    learnt, safe = ways("dishwasher")
    correction = plan(predicted(learnt), safe, [learnt, safe])
    middle = correction.displacement(0.5)
    assert np.linalg.norm(middle) > 0.05
    episode = Episode(correction, Hand(seed=6), offset=middle)
    episode.progress = 0.5
    assert not episode.hand.clutched
    while not episode.hand.clutched:
        episode.step()
        assert episode.time < 2.5
    assert np.linalg.norm(np.array(episode.stylus.state.position) - middle) < 0.02
    offsets = []
    for _ in range(300):
        episode.step()
        offsets.append(episode.offset)
    assert np.max(np.linalg.norm(np.diff(offsets, axis=0), axis=1)) < 0.2 * PERIOD
    assert np.linalg.norm(episode.robot - correction.position(episode.progress)) < 0.015
