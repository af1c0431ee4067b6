"""The runner's ticks are absolute: none is made up for in a burst, late ones are counted."""

import gc
import signal
import threading

import pytest

from protocol import topics
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock, utc_ms
from services.process.ending import ENDING
from services.process.release import release
from services.process.runner import TickStatistics, interruptible, leave_on_signals, run, stop_on_signals

MS = 1_000_000


class Slow:
    """A service whose steps take as long as it is told; it ends the run after the last."""

    rate_hz = 100.0

    def __init__(self, clock, stop, durations_ms):
        self.clock, self.stop, self.durations = clock, stop, list(durations_ms)
        self.started_ms = []
        self.closed = False
        self.frozen = 0

    def step(self, now_ns):
        self.frozen = self.frozen or gc.get_freeze_count()  # counting takes long: once
        self.started_ms.append((now_ns - 1_000_000_000) / MS)
        self.clock.advance(self.durations.pop(0) / 1e3)
        if not self.durations:
            self.stop.set()

    def figures(self):
        return ()

    def close(self):
        self.closed = True


@pytest.fixture(autouse=True)
def kept():
    """All that pytest keeps is out of the way of the runner, which looks through what is there for garbage."""
    gc.freeze()
    yield
    gc.freeze()


def ran(durations_ms):
    clock, stop = ManualClock(), threading.Event()
    network = MemoryNetwork(clock)
    beats = network.bus().subscribe(topics.HEARTBEAT)
    service = Slow(clock, stop, durations_ms)
    run(service, network.bus(), clock, "slow", stop)
    return service, beats


def test_ticks_come_at_whole_periods_whatever_the_steps_take():
    service, _ = ran([3, 9, 1, 5])
    assert service.started_ms == [0, 10, 20, 30]


def test_a_heartbeat_tells_the_time_of_day_and_the_release():
    """By which another machine sees that a clock is wrong, or that something else runs here."""
    before_ms = utc_ms()
    _, beats = ran([3])
    beat = beats.latest().message
    assert before_ms <= beat.utc_ms <= utc_ms()
    assert beat.software == release()


def test_a_long_step_skips_ticks_and_keeps_the_phase():
    service, _ = ran([35, 1, 1])
    assert service.started_ms == [0, 35, 40]


class Called(Slow):
    """A service to which something comes in the middle of its second period, and again at once."""

    def __init__(self, clock, stop, durations_ms):
        super().__init__(clock, stop, durations_ms)
        self.call = threading.Event()
        self.early_ms = []

    def step(self, now_ns):
        super().step(now_ns)
        if len(self.started_ms) == 2:
            self.call.set()

    def step_early(self, now_ns):
        self.early_ms.append((now_ns - 1_000_000_000) / MS)
        self.clock.advance(1e-3)
        if len(self.early_ms) < 2:
            self.call.set()


def test_what_calls_is_heard_between_the_ticks_and_moves_none():
    clock, stop = ManualClock(), threading.Event()
    service = Called(clock, stop, [3, 3, 3])
    run(service, MemoryNetwork(clock).bus(), clock, "called", stop)
    assert service.early_ms == [13, 14]
    assert service.started_ms == [0, 10, 20]


def test_what_called_before_a_tick_is_heard_in_it():
    clock, stop = ManualClock(), threading.Event()
    service = Called(clock, stop, [3])
    service.call.set()
    run(service, MemoryNetwork(clock).bus(), clock, "called", stop)
    assert service.early_ms == []


def test_what_was_made_at_the_start_is_not_looked_through_for_garbage_while_the_service_runs():
    gc.unfreeze()
    service, _ = ran([1, 1])
    assert service.frozen > 1000
    assert gc.get_freeze_count() == 0


def test_late_ticks_are_counted():
    ticks = TickStatistics(100.0)
    for due, started in ((0, 0), (10, 14), (20, 26), (30, 39)):
        ticks.tick(due * MS, started * MS, started * MS)
    assert (ticks.ticks, ticks.late) == (4, 2)


def test_quantiles_are_of_the_last_interval():
    ticks = TickStatistics(100.0)
    for i in range(101):
        ticks.tick(i * 10 * MS, i * 10 * MS, i * 10 * MS + MS)
    assert ticks.take_quantiles() == pytest.approx((0.01, 0.01, 0.001))
    assert ticks.take_quantiles() == (0.0, 0.0, 0.0)


def test_the_heartbeat_comes_twice_a_second():
    _, beats = ran([1] * 200)
    assert len(beats.take()) == 4


def test_the_service_is_closed_where_a_step_fails():
    clock, stop = ManualClock(), threading.Event()
    service = Slow(clock, stop, [])
    with pytest.raises(IndexError):
        run(service, MemoryNetwork(clock).bus(), clock, "broken", stop)
    assert service.closed


@pytest.fixture
def handlers():
    """The signals' handlers are put back after the test."""
    numbers = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)
    before = [signal.getsignal(number) for number in numbers]
    yield
    for number, handler in zip(numbers, before, strict=True):
        signal.signal(number, handler)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_a_lost_terminal_stops_as_sigterm_and_ctrl_c_do(handlers, number):
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    stop = stop_on_signals()
    signal.raise_signal(number)
    assert stop.is_set()


def test_what_was_started_to_outlive_its_terminal_does(handlers):
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    stop = stop_on_signals()
    signal.raise_signal(signal.SIGHUP)
    assert not stop.is_set()


def test_a_start_is_left_where_it_stands(handlers):
    leave_on_signals()
    with pytest.raises(SystemExit) as left:
        signal.raise_signal(signal.SIGTERM)
    assert left.value.code == 0


def test_what_could_be_interrupted_and_was_not_leaves_the_signals_as_they_were():
    before = [signal.getsignal(number) for number in ENDING]
    with interruptible():
        assert [signal.getsignal(number) for number in ENDING] != before
    assert [signal.getsignal(number) for number in ENDING] == before
    assert signal.set_wakeup_fd(-1) == -1
