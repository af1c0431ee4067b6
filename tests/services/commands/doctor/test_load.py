"""A way is loaded until more on it does not help: what it bears is found, and no queue is left standing on it."""

import heapq

import pytest

from services.commands.doctor import pictures
from services.commands.doctor.finding import Verdict
from services.commands.doctor.load import MOST, Load

MS = 1_000_000
CHUNK = pictures.CHUNK_BYTES
WAIT_NS = round(pictures.WAIT_S * 1e9)


class Way:
    """A link that carries so much a second, and so far; chunks queue before it.

    Args:
        rate: [byte/s].
        trip_ms: there and back [ms].
        lost: numbers of chunks that do not come.
    """

    def __init__(self, rate, trip_ms, lost=()):
        self.rate, self.trip_ns, self.lost = rate, round(trip_ms * MS), set(lost)
        self.free_ns = 0
        self.longest_queue_ns = 0
        self.on_it = []

    def send(self, number, now_ns):
        self.free_ns = max(self.free_ns, now_ns) + round(CHUNK / self.rate * 1e9)
        self.longest_queue_ns = max(self.longest_queue_ns, self.free_ns - now_ns)
        if number not in self.lost:
            heapq.heappush(self.on_it, (self.free_ns + self.trip_ns, number))

    def come(self, now_ns):
        while self.on_it and self.on_it[0][0] <= now_ns:
            received_ns, number = heapq.heappop(self.on_it)
            yield number, received_ns


def loaded(way, most_bytes=pictures.MOST_BYTES, within_ns=pictures.WITHIN_NS):
    """The load, once it has ended, and when that was [ns]."""
    load = Load(CHUNK, most_bytes, pictures.ENOUGH, within_ns, 0)
    now_ns = 0
    while not load.ended:
        for number in load.step(now_ns, list(way.come(now_ns))):
            way.send(number, now_ns)
        now_ns = min(now_ns + WAIT_NS, way.on_it[0][0] if way.on_it else now_ns + WAIT_NS)
    return load, now_ns


@pytest.mark.parametrize("trip_ms", [0.5, 20.0, 80.0])
@pytest.mark.parametrize("megabits", [0.5, 2.0, 8.0])
def test_what_a_way_bears_is_found(megabits, trip_ms):
    load, _ = loaded(Way(megabits * 1e6 / 8, trip_ms))
    assert load.rate * 8e-6 == pytest.approx(megabits, rel=0.15)
    assert load.lost == 0


@pytest.mark.parametrize("trip_ms", [0.5, 20.0, 80.0])
@pytest.mark.parametrize("megabits", [0.5, 2.0, 8.0, 100.0, 1000.0])
def test_it_takes_no_longer_and_no_more_than_it_may(megabits, trip_ms):
    load, ended_ns = loaded(Way(megabits * 1e6 / 8, trip_ms))
    assert ended_ns <= pictures.WITHIN_NS + 2 * WAIT_NS
    assert load.sent * CHUNK <= pictures.MOST_BYTES


@pytest.mark.parametrize("trip_ms", [0.5, 20.0, 80.0])
@pytest.mark.parametrize("megabits", [1.0, 4.0, 16.0])
def test_the_queue_that_it_makes_is_three_trips_long_or_two_pictures(megabits, trip_ms):
    """Less than four times as much as fills the way is on it."""
    way = Way(megabits * 1e6 / 8, trip_ms)
    loaded(way)
    picture_ns = 8 * CHUNK / way.rate * 1e9
    assert way.longest_queue_ns <= max(picture_ns, 3.0 * (trip_ms * MS + CHUNK / way.rate * 1e9))


def test_a_wide_way_is_not_filled_to_find_out_how_wide():
    way = Way(1e9 / 8, 5.0)
    load, ended_ns = loaded(way)
    assert load.rate >= pictures.ENOUGH
    assert load.sent * CHUNK < way.rate * ended_ns / 1e9 / 10
    assert "more than" in pictures.judged(load).found


def test_a_long_and_wide_way_is_not_known_and_said_to_be_more():
    load, _ = loaded(Way(1e9 / 8, 400.0))
    assert load.grew
    found = pictures.judged(load)
    assert "more than" in found.found


def test_what_is_dropped_ends_it():
    load, _ = loaded(Way(1e6, 5.0, lost=(9,)))
    assert load.lost == 1
    assert load.rate > 0.0


def test_where_nothing_comes_it_ends_soon():
    load, ended_ns = loaded(Way(1e6, 5.0, lost=range(10_000)))
    assert load.rate == 0.0
    assert ended_ns < 1e9
    assert pictures.judged(load).verdict is Verdict.WRONG


def test_no_more_than_so_many_are_on_the_way_at_once():
    way = Way(1e12, 50.0)
    load = Load(CHUNK, pictures.MOST_BYTES, pictures.ENOUGH, pictures.WITHIN_NS, 0)
    for now_ns in range(0, 2_000 * MS, MS):
        for number in load.step(now_ns, list(way.come(now_ns))):
            way.send(number, now_ns)
        assert len(way.on_it) <= MOST


@pytest.mark.parametrize(
    ("megabits", "verdict"), [(0.05, Verdict.WRONG), (1.0, Verdict.LOOK), (2.5, Verdict.LOOK), (6.0, Verdict.OK)]
)
def test_two_cameras_need_three(megabits, verdict):
    load, _ = loaded(Way(megabits * 1e6 / 8, 20.0))
    assert pictures.judged(load).verdict is verdict


def test_nothing_that_comes_back_is_wrong():
    assert pictures.judged(None).verdict is Verdict.WRONG
