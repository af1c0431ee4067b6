"""One rule of time for all methods: what counts is a motion that the operator leads; the rest is kept raw."""

import pytest

from protocol.messages import Attempt, Light, Mode, ModelState, Outcome, Phase, Pose, RobotState, TeachingState
from protocol.topics import MODEL_STATE, ROBOT_STATE, TEACHING_STATE
from services.bus.memory import MemoryNetwork
from services.offline.people.ways import Teaching
from services.process.clock import ManualClock
from services.study.session.watch import GAP_S, Watch

PERIOD_S = 0.01
POSE = Pose(position=(0.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0))


class Site:
    """A robot and a station that say what they are told to, and a watch."""

    def __init__(self, **known):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.bus, self.station = self.network.bus(), self.network.bus()
        self.watch = Watch(self.network.bus(), 3, "OnKey/1", Teaching.PREDICTION, **known)
        self.attempts = ()
        self.seen = []
        self.run(PERIOD_S)

    def run(self, seconds, phase=Phase.IDLE, mode=Mode.AUTONOMOUS, every_s=PERIOD_S):
        """Let the robot do something for a while."""
        for _ in range(round(seconds / every_s)):
            self.clock.advance(every_s)
            self.bus.publish(ROBOT_STATE, RobotState(measured=POSE, reference=POSE, phase=phase, mode=mode))
            told = TeachingState(phase="x", text="", light=Light.RED, attempts=self.attempts)
            self.station.publish(TEACHING_STATE, told)
            self.seen += self.watch.step(self.clock.now_ns())

    def learn(self, updates):
        """The model has learnt so often."""
        state = ModelState(kind="adaptive", version=updates + 1, demonstrations=2, updates=updates, scene="dishwasher")
        self.bus.publish(MODEL_STATE, state)

    def end(self, mode, *, success=True):
        """An attempt has ended."""
        number = self.attempts[-1].number + 1 if self.attempts else 1
        one = Attempt(
            scene="", object_position=(0.0, 0.0, 0.0), model_version=1, operator_input=False, duration_s=1.0,
            variant="", verdict=Outcome(reached=success, kicked_over=False, collision=False), mode=mode, number=number,
        )  # fmt: skip
        self.attempts = (*self.attempts, one)
        self.run(PERIOD_S)


@pytest.mark.parametrize("mode", [Mode.REFINE, Mode.TEACH])
def test_only_a_motion_that_is_led_or_corrected_counts(mode):
    site = Site()
    site.run(0.5, Phase.RAMP, mode)
    site.run(2.0, Phase.EXECUTE, mode)
    site.run(0.7, Phase.HOLD, mode)
    site.run(1.0, Phase.EXECUTE, Mode.AUTONOMOUS)
    site.end(mode)
    (attempt,) = site.seen
    assert attempt.active == pytest.approx(2.0, abs=2 * PERIOD_S)
    assert attempt.raw["holding"] == pytest.approx(0.7, abs=2 * PERIOD_S)
    assert attempt.raw["alone"] == pytest.approx(1.0, abs=2 * PERIOD_S)
    assert sum(attempt.raw.values()) == pytest.approx(attempt.ended - attempt.began, abs=2 * PERIOD_S)


def test_what_was_led_before_an_attempt_is_executed_counts_for_it():
    """Way-points are stored in one motion, and tried in another."""
    site = Site()
    site.run(3.0, Phase.EXECUTE, Mode.TEACH)
    site.run(1.0, Phase.EXECUTE, Mode.AUTONOMOUS)
    site.end(Mode.TEACH)
    assert site.seen[0].active == pytest.approx(3.0, abs=2 * PERIOD_S)


def test_attempts_are_numbered_on_and_their_times_follow_each_other():
    site = Site(known=4, lasted=100.0)
    site.end(Mode.AUTONOMOUS, success=False)
    site.run(1.0, Phase.EXECUTE, Mode.REFINE)
    site.end(Mode.REFINE)
    first, second = site.seen
    assert (first.number, second.number) == (5, 6)
    assert (first.teaching, second.teaching) == (None, Teaching.PREDICTION)
    assert 100.0 <= first.began <= first.ended == second.began < second.ended
    assert first.part == second.part == "OnKey/1"


def test_what_the_station_had_before_is_not_told():
    site = Site()
    site.end(Mode.AUTONOMOUS)
    other = Watch(site.bus, 3, "OnKey/2", Teaching.PREDICTION)
    site.watch = other
    site.seen.clear()
    site.run(0.1)
    assert site.seen == []
    site.end(Mode.AUTONOMOUS)
    assert len(site.seen) == 1


def test_a_robot_that_is_not_heard_counts_for_nothing():
    site = Site()
    site.run(1.0, Phase.EXECUTE, Mode.REFINE)
    site.clock.advance(30.0)
    site.watch.step(site.clock.now_ns())
    assert site.watch.active == pytest.approx(1.0, abs=GAP_S + 2 * PERIOD_S)


def test_a_station_that_was_started_again_counts_anew_and_no_attempt_is_lost_or_told_twice():
    site = Site()
    site.end(Mode.REFINE)
    site.station, site.attempts = site.network.bus(), ()
    site.run(0.1)
    site.end(Mode.AUTONOMOUS)
    site.run(0.1)
    assert [one.number for one in site.seen] == [1, 2]


def test_updates_are_those_that_the_model_had_before_the_attempt():
    site = Site()
    site.learn(1)
    site.run(0.1)
    site.learn(2)
    site.end(Mode.REFINE)
    assert site.seen[0].updates == 1
    assert site.watch.updates == 2
