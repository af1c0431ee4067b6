"""How far an episode went, and how far before it spoilt something."""

import numpy as np
import pytest

from lfd.motion.trajectory import Trajectory
from protocol.messages import Cut
from services.robot.backends.backend import Touch
from services.robot.correction import UNCORRECTED
from services.robot.episode import Episode
from services.robot.execution import Execution
from services.robot.verdict import Verdict
from sim.pose import Pose

PERIOD = 0.01
UPRIGHT = np.array([1.0, 0.0, 0.0, 0.0])
HERE = Pose(np.zeros(3), UPRIGHT)
WELL = Verdict(reached=False, kicked_over=False, collision=None, ellipsoid_value=2.0, displacement=np.zeros(3))
HIT = Verdict(
    reached=False,
    kicked_over=False,
    collision=Touch(np.zeros(3), 1.0, ("hand", "basket")),
    ellipsoid_value=2.0,
    displacement=np.zeros(3),
)
KICKED = Verdict(reached=True, kicked_over=True, collision=None, ellipsoid_value=0.5, displacement=np.zeros(3))


class Running:
    """An episode of two seconds, past its ramp."""

    def __init__(self):
        self.verdict = WELL
        path = np.column_stack([np.linspace(0.0, 0.2, 75), np.zeros(75), np.zeros(75)])
        motion = Trajectory(path, np.tile(UPRIGHT, (75, 1)), 2.0)
        self.episode = Episode(Execution(HERE, motion, 0.02, PERIOD), PERIOD)
        while self.episode.execution.ramping:
            self.go_on(PERIOD)

    def go_on(self, seconds, verdict=None):
        self.verdict = verdict or self.verdict
        for _ in range(round(seconds / PERIOD)):
            reference = self.episode.advance(UNCORRECTED, HERE)
            self.episode.judged(self.verdict)
            self.episode.record(reference, reference, reference, clamped=False)

    def shares(self, stopped=""):
        outcome = self.episode.outcome(self.verdict, HERE, stopped)
        return outcome.progress, outcome.clear_until


def test_what_touches_nothing_is_clear_to_its_end():
    running = Running()
    running.go_on(3.0)
    assert running.shares() == (1.0, 1.0)


@pytest.mark.parametrize("spoilt", [HIT, KICKED], ids=["touched", "kicked over"])
def test_it_is_clear_until_something_is_touched_or_kicked_over(spoilt):
    running = Running()
    running.go_on(0.8)
    running.go_on(1.6, spoilt)
    assert running.shares() == (1.0, pytest.approx(0.4, abs=0.011))


def test_what_was_touched_first_counts():
    running = Running()
    running.go_on(0.4)
    running.go_on(0.4, HIT)
    running.go_on(1.4, KICKED)
    assert running.shares() == (1.0, pytest.approx(0.2, abs=0.011))


def test_what_is_cut_short_went_as_far_as_it_went():
    running = Running()
    running.go_on(1.0)
    running.episode.cut_short(Cut.FINISHED, "enough", HERE)
    running.go_on(0.5)
    progress, clear_until = running.shares()
    assert progress == clear_until == pytest.approx(0.5, abs=0.011)


def test_the_motions_of_an_outcome_are_as_far_as_its_progress():
    running = Running()
    running.go_on(1.0)
    outcome = running.episode.outcome(WELL, HERE, "stopped")
    assert outcome.commanded.duration == pytest.approx(2.0 * outcome.progress, abs=2 * PERIOD)
    assert outcome.commanded.positions[-1, 0] == pytest.approx(0.2 * outcome.progress, abs=0.003)
