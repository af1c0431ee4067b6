"""A hand's motion is played out as the hand made it, as soon as its samples allow, and its letting go at once."""

import itertools
import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from protocol.messages import MasterState
from services.bus.subscription import Received
from services.robot.playout import MOST_NS, OLDEST_NS, Playout

MS = 1_000_000
PERIOD_NS = 10 * MS
APART_NS = 7_000_000_000
"""Between the clocks of master and robot."""


def hand(stamp_ns, *, engaged=True, publisher=1):
    """Back and forth along x, 5 cm in a second."""
    x = 0.05 * np.sin(2.0 * np.pi * 0.5 * stamp_ns / 1e9)
    return MasterState(displacement=(float(x), 0.0, 0.0), engaged=engaged, publisher=publisher, stamp_ns=stamp_ns)


def played(ways_ns, *, seconds=6.0, way_ns=20 * MS):
    """What a robot with periods of 10 ms plays out of a hand whose samples take these ways, the newest only."""
    playout, arrivals, out = Playout(), [], []
    for number, extra in zip(range(int(seconds * 100)), ways_ns, strict=False):
        stamp = number * PERIOD_NS
        arrivals.append((APART_NS + stamp + way_ns + extra, number, hand(stamp)))
    arrivals.sort()
    newest, waiting = None, iter([*arrivals, (2**62, 0, None)])
    due = next(waiting)
    for tick in range(int(seconds * 100)):
        now = APART_NS + tick * PERIOD_NS
        while due[0] <= now:
            if newest is None or due[2].stamp_ns > newest.message.stamp_ns:  # as a subscription does
                newest = Received(due[2], due[0])
                playout.hear(newest, way_ns)
            due = next(waiting)
        if newest is not None:
            out.append((now, newest, playout.play(newest, now), playout.delay_ns))
    return out


def speeds(samples):
    """Of the displacement, from period to period [m/s]."""
    return np.diff([sample.displacement[0] for sample in samples]) / 0.01


def jitter(seed, most_ns):
    rng = random.Random(seed)
    return (rng.randrange(most_ns) for _ in itertools.count())


def test_what_comes_regularly_is_not_delayed_and_not_changed():
    for _, newest, out, delay in played(itertools.repeat(0)):
        assert out is newest
        assert delay == 0


def test_a_period_s_jitter_is_not_worth_a_delay():
    assert all(out is newest for _, newest, out, _ in played(jitter(1, 9 * MS)))


@pytest.mark.parametrize("most_ms", [30, 60, 120])
def test_a_motion_whose_samples_come_irregularly_is_played_out_smoothly(most_ms):
    out = played(jitter(2, most_ms * MS))[250:]
    smooth, rough = speeds([one.message for _, _, one, _ in out]), speeds([newest.message for _, newest, _, _ in out])
    fastest = 0.05 * 2.0 * np.pi * 0.5
    assert np.quantile(np.abs(smooth), 0.98) <= 1.3 * fastest < np.quantile(np.abs(rough), 0.98)
    assert np.std(np.diff(smooth)) <= 0.25 * np.std(np.diff(rough))


def test_bursts_are_spread_out_as_the_hand_made_them():
    """A link that delivers every 50 ms what has gathered meanwhile, as radio links do."""
    ways = ((-number * 10 % 50) * MS for number in itertools.count())
    out = played(ways)[250:]
    assert np.abs(speeds([one.message for _, _, one, _ in out])).max() <= 1.3 * 0.05 * np.pi


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**32), most_ms=st.integers(1, 400), way_ms=st.integers(0, 240))
def test_it_goes_never_back_and_is_never_later_than_it_may_be(seed, most_ms, way_ms):
    before = 0
    for now, newest, out, delay in played(jitter(seed, most_ms * MS), seconds=3.0, way_ns=way_ms * MS):
        assert 0 <= delay <= max(0, min(MOST_NS, OLDEST_NS - way_ms * MS))
        assert out.received_ns == newest.received_ns, "whether the hand is there is told by what came"
        assert out.message.stamp_ns <= newest.message.stamp_ns
        assert out.message.stamp_ns >= before
        before = out.message.stamp_ns
        assert now >= APART_NS


def test_the_delay_goes_when_the_jitter_does():
    ways = itertools.chain(itertools.islice(jitter(3, 60 * MS), 300), itertools.repeat(0))
    out = played(ways, seconds=9.0)
    assert out[290][3] > 20 * MS
    assert out[-1][2] is out[-1][1]


def test_a_hand_that_lets_go_is_seen_at_once():
    playout = Playout()
    ways = jitter(4, 60 * MS)
    for number in range(300):
        stamp = number * PERIOD_NS
        newest = Received(hand(stamp), stamp + next(ways))
        playout.hear(newest, 0)
        playout.play(newest, newest.received_ns)
    gone = Received(hand(3000 * MS, engaged=False), 3020 * MS)
    playout.hear(gone, 0)
    assert playout.play(gone, 3020 * MS) is gone
    again = Received(hand(3010 * MS), 3030 * MS)
    playout.hear(again, 0)
    assert playout.play(again, 3030 * MS).message.displacement == again.message.displacement


def test_another_master_s_motion_does_not_go_on_from_the_first_one_s():
    playout = Playout()
    ways = jitter(5, 60 * MS)
    for number in range(300):
        stamp = number * PERIOD_NS
        playout.hear(Received(hand(stamp), stamp + next(ways)), 0)
    other = Received(hand(40 * MS, publisher=2), 3100 * MS)
    playout.hear(other, 0)
    assert playout.delay_ns == 0
    assert playout.play(other, 3100 * MS) is other


def test_after_a_jump_of_the_clocks_it_plays_what_comes():
    playout, out = Playout(), []
    for number in range(600):
        stamp = number * PERIOD_NS + (5_000_000_000 if number >= 300 else 0)
        received = Received(hand(stamp), number * PERIOD_NS + 20 * MS)
        playout.hear(received, 0)
        out.append((received, playout.play(received, received.received_ns)))
    assert all(played is newest for newest, played in out[550:])
