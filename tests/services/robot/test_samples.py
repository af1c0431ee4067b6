"""Which of the master's samples count, on a machine whose clock is another one."""

import pytest

from protocol.messages import MasterState
from protocol.topics import MASTER_STATE
from services.bus.identity import new_publisher
from services.bus.memory import MemoryNetwork
from services.bus.outbox import Outbox
from services.process.clock import ManualClock
from services.robot.samples import Samples

AHEAD_NS = 7_000_000_000_000
HELD_NS = 2_000_000
PERIOD_S = 0.01


class Far:
    """A robot, and a master on another machine."""

    def __init__(self):
        self.clock = ManualClock(10**12)
        self._network = MemoryNetwork(self.clock)
        self.samples = Samples(self._network.bus("robot"))
        self._master = Outbox(new_publisher() ^ (1 << 50), self._network.robot, "master")
        self.let_go = 0

    def send(self, there_s, back_s, engaged=True):
        """A sample comes now; it echoes the robot's state from before; what counts after it."""
        self.clock.advance(PERIOD_S)
        now = self.clock.now_ns()
        stamp = now - round(back_s * 1e9) + AHEAD_NS
        echoed = now - round((there_s + back_s) * 1e9) - HELD_NS
        state = MasterState(engaged=engaged, echoed_ns=echoed, echo_held_ns=HELD_NS)
        self._network.deliver(MASTER_STATE, self._master.pack(MASTER_STATE, state, stamp))
        return self.samples.take(lambda holder, epoch, process: True, self._let_go, self.clock.now_ns())

    def _let_go(self):
        self.let_go += 1


@pytest.fixture
def far():
    return Far()


def test_how_long_a_sample_was_on_its_way_is_known_by_the_round_trip(far):
    sample = far.send(0.05, 0.05)
    assert far.samples.way_s(sample) == pytest.approx(0.05, abs=1e-6)


def test_the_newest_way_and_how_far_the_clocks_are_apart_are_told(far):
    assert far.samples.newest_way_s is None
    assert far.samples.ahead_s is None
    far.send(0.05, 0.05)
    assert far.samples.newest_way_s == pytest.approx(0.05, abs=1e-6)
    assert far.samples.ahead_s == pytest.approx(-AHEAD_NS / 1e9, abs=1e-3), "the master's clock is ahead"


def test_what_was_on_its_way_for_longer_than_the_bound_never_counts_and_is_counted(far):
    assert far.send(0.3, 0.3) is None
    assert far.samples.late == 1


def test_a_hand_that_was_taken_off_is_heard_however_late(far):
    assert far.send(0.3, 0.3, engaged=False) is None
    assert far.let_go == 1


def test_before_any_round_trip_and_for_nothing_no_way_is_known(far):
    assert far.samples.way_s(None) == 0.0
