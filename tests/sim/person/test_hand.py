import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from sim.person.attention import REACTION
from sim.person.hand import ARM, DAMPING, STIFFNESS, WRIST, Hand, Seen
from sim.person.intention import plan
from sim.person.stylus import Stylus, StylusState
from sim.pose import Pose
from sim.rotations import rotated, rotation_to
from sim.tasks import DISHWASHER, THESIS

FEEDBACK = 50.0  # [N/m] of equation (14)
FEEDBACK_DAMPING = 2.0  # [N s/m]
PERIOD = 0.01
OBJECT = {
    "dishwasher": np.array([0.87, 0.07, 0.553]),
    "table": np.array([0.70, 0.10, 0.71]),
    "post": np.array([0.89, 0.02, 0.55]),
}


def ways(name):
    scene = THESIS[name]
    return [scene.corridor(variant, OBJECT[name]) for variant in scene.variants]


def predicted(way, n=75):
    """What a robot would do that learnt the way: at rest at both ends, smooth between; positions and orientations."""
    s = np.linspace(0.0, 1.0, n)
    share = s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
    fine = np.linspace(0.0, len(way.positions) - 1.0, 500)
    line, turns = (PchipInterpolator(np.arange(len(part)), part)(fine) for part in way[:2])
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    positions, orientations = (
        np.column_stack([np.interp(share, lengths / lengths[-1], column) for column in part.T])
        for part in (line, turns)
    )
    return positions, orientations / np.linalg.norm(orientations, axis=1, keepdims=True)


def rolled(prediction, angle):
    """The prediction, wrongly rolled: from a quarter on more and more, from the middle on by the angle."""
    positions, orientations = prediction
    share = np.clip(np.linspace(-1.0, 3.0, len(positions)), 0.0, 1.0)
    return positions, rotated(orientations, np.outer(share, [angle, 0.0, 0.0]))


def with_feedback(push, state):
    axes = zip(push, state.position, state.velocity, strict=True)
    return tuple(f - FEEDBACK * x - FEEDBACK_DAMPING * v for f, x, v in axes)


class Episode:
    """A robot that follows the stylus as equation (16) says, and a hand that looks at it."""

    def __init__(self, correction, hand, duration=20.0, offset=(0.0, 0.0, 0.0), turn=(0.0, 0.0, 0.0)):
        self.correction, self.hand, self.duration = correction, hand, duration
        self.look_ahead = duration / 74
        self.stylus = Stylus()
        self.offset, self.turn = np.array(offset), np.array(turn)
        self.progress = 0.0
        self.time = 0.0
        hand.grip(correction, self.stylus.state)

    @property
    def robot(self):
        wanted, correction = self.correction.pose(self.progress), self.correction
        nominal = rotated(wanted.orientation, -correction.rotation(self.progress))
        position = wanted.position - correction.displacement(self.progress) + self.offset
        return Pose(position, rotated(nominal, self.turn))

    @property
    def misplaced(self):
        """How far the robot is from where the operator wants it [m]."""
        return np.linalg.norm(self.robot.position - self.correction.pose(self.progress).position)

    @property
    def misturned(self):
        """The same of its orientation [rad]."""
        wanted = self.correction.pose(self.progress).orientation
        return np.linalg.norm(rotation_to(self.robot.orientation, wanted))

    def step(self, moving=True):
        seen = Seen(self.progress, self.robot, self.offset.copy(), self.turn.copy(), self.stylus.state)
        target = self.hand.observe(self.time, seen)
        for _ in range(10):
            state = self.stylus.state
            self.stylus.step(with_feedback(self.hand.force(state), state), PERIOD / 10, self.hand.rotation)
        if moving and self.hand.clutched:
            self.progress = min(1.0, self.progress + PERIOD / self.duration)
            gain, state = PERIOD / self.look_ahead, self.stylus.state
            self.offset = self.offset + gain * (np.array(state.position) - self.offset)
            self.turn = self.turn + gain * (np.array(state.rotation) - self.turn)
        self.time += PERIOD
        return target


def test_the_spring_of_the_feedback_pulls_the_stylus_short_of_the_target():
    """Steady state of two springs against each other: x = K_h / (K_h + k) target."""
    correction = plan(*ways("table")[0][:2], ways("table")[0], ways("table"))
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
    assert hand.rotation is None
    nothing = Seen(0.0, DISHWASHER.start, np.zeros(3), np.zeros(3), state)
    assert hand.observe(0.0, nothing) is None
    hand.grip(plan(*ways("table")[0][:2], ways("table")[0], ways("table")), state)
    assert hand.force(state) == pytest.approx((-0.1 * DAMPING, 0.0, 0.1 * DAMPING))
    assert hand.rotation == state.rotation
    hand.release()
    assert hand.force(state) == (0.0, 0.0, 0.0)
    assert hand.rotation is None


@pytest.mark.parametrize("name", THESIS)
def test_the_way_that_is_safe_is_left_alone(name):
    _, safe = ways(name)
    correction = plan(*predicted(safe), safe, ways(name))
    assert np.max(np.abs(correction.displacements)) < 1e-3
    assert np.max(np.abs(correction.rotations)) < 1e-3


@pytest.mark.parametrize("name", THESIS)
def test_a_recognised_way_is_moved_way_point_by_way_point(name):
    learnt, safe = ways(name)
    positions, orientations = predicted(learnt)
    correction = plan(positions, orientations, safe, ways(name))
    for before, after, turned in zip(learnt.positions, *safe[:2], strict=True):
        passed = np.argmin(np.linalg.norm(positions - before, axis=1))
        moved = correction.pose(passed / (len(positions) - 1))
        np.testing.assert_allclose(moved.position, after, atol=0.02)
        assert np.linalg.norm(rotation_to(moved.orientation, turned)) < 0.02
    assert np.max(np.abs(correction.rotations)) < 1e-3, "the two ways turn alike"


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_orientation_that_was_learnt_wrongly_is_turned_back_where_it_is_wrong(sign):
    """By minus the wrong rotation, since it was the last one; whichever sign the quaternions have."""
    safe = ways("dishwasher")[1]
    positions, orientations = rolled(predicted(safe), 0.5)
    correction = plan(positions, sign * orientations, safe, [safe])
    expected = np.outer(np.clip(np.linspace(-1.0, 3.0, 75), 0.0, 1.0), [-0.5, 0.0, 0.0])
    np.testing.assert_allclose(correction.rotations, expected, atol=1e-3)
    np.testing.assert_allclose(correction.displacements, 0.0, atol=1e-3)


def test_exaggeration_multiplies_the_correction():
    learnt, safe = ways("dishwasher")
    natural = plan(*rolled(predicted(learnt), 0.2), safe, [learnt, safe])
    double = plan(*rolled(predicted(learnt), 0.2), safe, [learnt, safe], exaggeration=2.0)
    np.testing.assert_allclose(double.displacements, 2.0 * natural.displacements)
    np.testing.assert_allclose(double.rotations, 2.0 * natural.rotations)


@pytest.mark.sim
@pytest.mark.parametrize("name", THESIS)
def test_the_robot_ends_up_on_the_safe_way_and_at_the_object(name):
    """A prediction that goes wrong by more than 0.1 m, and ends 0.03 m beside the object and rolled, is put right."""
    learnt, safe = ways(name)
    positions, orientations = rolled(predicted(learnt), 0.5)
    wrong = positions + np.linspace(0.0, 0.03, 75)[:, np.newaxis] * np.array([0.0, 1.0, 0.0])
    correction = plan(wrong, orientations, safe, [learnt, safe])
    assert np.max(np.linalg.norm(correction.displacements, axis=1)) > 0.1
    episode = Episode(correction, Hand(seed=3))
    misplaced, misturned = [], []
    while episode.progress < 1.0:
        episode.step()
        misplaced.append(episode.misplaced)
        misturned.append(episode.misturned)
    assert max(misplaced) < 0.015
    assert max(misturned) < 0.05
    assert np.linalg.norm(episode.robot.position - safe.positions[-1]) < 0.01
    assert episode.misturned < 0.02


@pytest.mark.sim
def test_the_hand_keeps_to_human_speed_and_trembles_little():
    learnt, safe = ways("dishwasher")
    correction = plan(*rolled(predicted(learnt), 0.8), safe, [learnt, safe])
    episode = Episode(correction, Hand(seed=1), duration=3.0)
    targets, turns = [], []
    while episode.progress < 1.0:
        targets.append(episode.step())
        turns.append(episode.stylus.state.rotation)
    assert np.max(np.linalg.norm(np.diff(targets, axis=0), axis=1)) <= ARM.speed * PERIOD * (1.0 + 1e-9)
    assert np.max(np.linalg.norm(np.diff(turns, axis=0), axis=1)) <= WRIST.speed * PERIOD * (1.0 + 1e-9)

    alone = plan(*predicted(safe), safe, [safe])
    still = Episode(alone, Hand(seed=1))
    rest = [(still.step(moving=False), still.stylus.state.rotation) for _ in range(1000)]
    assert 0.0005 < np.std([target for target, _ in rest]) < 0.002
    assert 0.002 < np.std([turn for _, turn in rest]) < 0.006


def test_a_seed_makes_a_hand():
    learnt, safe = ways("table")
    correction = plan(*predicted(learnt), safe, [learnt, safe])

    def moved(seed):
        episode = Episode(correction, Hand(seed))
        return np.array([(*episode.step(), *episode.stylus.state.rotation) for _ in range(200)])

    np.testing.assert_array_equal(moved(4), moved(4))
    assert np.all(np.any(moved(4) != moved(5), axis=0))


def test_surprises_are_acted_on_after_the_reaction_time_only():
    """Two robots, one of which is pushed aside: the hand does the same until a reaction time has passed."""
    safe = DISHWASHER.corridor("b1", OBJECT["dishwasher"])
    correction = plan(*predicted(safe), safe, [safe])
    quiet, pushed = Episode(correction, Hand(seed=2)), Episode(correction, Hand(seed=2))
    for _ in range(100):
        quiet.step()
        pushed.step()
    pushed.offset, pushed.turn = pushed.offset + 0.03, pushed.turn + 0.2
    before = round(REACTION / PERIOD)
    for _ in range(before):
        np.testing.assert_array_equal(quiet.step(), pushed.step())
        assert quiet.hand.rotation == pushed.hand.rotation
        pushed.offset, pushed.turn = np.maximum(pushed.offset, 0.03), np.maximum(pushed.turn, 0.2)
    for _ in range(before):
        quiet_target, pushed_target = quiet.step(), pushed.step()
    assert np.all(np.array(pushed_target) < np.array(quiet_target))
    assert np.all(np.array(pushed.hand.rotation) < np.array(quiet.hand.rotation))


@pytest.mark.sim
def test_coming_back_in_the_middle_the_clutch_closes_where_the_robot_stands():
    """A new stylus starts at zero while the robot holds a correction: it takes over without a jump."""
    learnt, safe = ways("dishwasher")
    correction = plan(*rolled(predicted(learnt), 0.5), safe, [learnt, safe])
    middle, turn = correction.displacement(0.5), correction.rotation(0.5)
    assert np.linalg.norm(middle) > 0.05
    assert np.linalg.norm(turn) > 0.15
    episode = Episode(correction, Hand(seed=6), offset=middle, turn=turn)
    episode.progress = 0.5
    assert not episode.hand.clutched
    while not episode.hand.clutched:
        episode.step()
        assert episode.time < 2.5
    assert np.linalg.norm(np.array(episode.stylus.state.position) - middle) < 0.02
    assert np.linalg.norm(np.array(episode.stylus.state.rotation) - turn) < 0.05
    offsets, turns = [], []
    for _ in range(300):
        episode.step()
        offsets.append(episode.offset)
        turns.append(episode.turn)
    assert np.max(np.linalg.norm(np.diff(offsets, axis=0), axis=1)) < 0.2 * PERIOD
    assert np.max(np.linalg.norm(np.diff(turns, axis=0), axis=1)) < 0.5 * PERIOD
    assert episode.misplaced < 0.015
    assert episode.misturned < 0.05
