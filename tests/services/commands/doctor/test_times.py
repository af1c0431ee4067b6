"""What stamps say of another machine's clock, and what they do not."""

import random

import pytest

from services.bus.identity import new_publisher
from services.commands.doctor.finding import Verdict
from services.commands.doctor.hearing import Beat, Sample
from services.commands.doctor.times import evenness, time_of_day
from tests.services.commands.doctor.test_processes import heartbeat

MS = 1_000_000
OWN = new_publisher()
AWAY = OWN ^ (1 << 50)
OFFSET_NS = 7_000_000_000_000
"""Clocks of two machines that have nothing to do with each other."""


def samples(delays_ms, publisher=AWAY, period_ms=10, jump_ns=lambda i: 0):
    """One a period, each of which was on the way for so long."""
    return [
        Sample(publisher, OFFSET_NS + jump_ns(i) + i * period_ms * MS, i * period_ms * MS + round(delay * MS))
        for i, delay in enumerate(delays_ms)
    ]


def test_even_samples_of_another_machine():
    rng = random.Random(1)
    (found,) = evenness(samples([20 + rng.uniform(0, 3) for _ in range(150)]), OWN)
    assert found.verdict is Verdict.OK
    assert "100 times a second" in found.found
    assert "after they were stamped" not in found.found, "how far the clocks are apart is not known"


def test_of_this_machines_own_the_age_is_known():
    mine = [Sample(OWN, i * 10 * MS, i * 10 * MS + 2 * MS) for i in range(150)]
    (found,) = evenness(mine, OWN)
    assert "2.0 ms after they were stamped by this machine's own clock" in found.found


def test_an_uneven_way():
    rng = random.Random(2)
    (found,) = evenness(samples([20 + rng.uniform(0, 90) for _ in range(150)]), OWN)
    assert found.verdict is Verdict.LOOK


def test_a_robot_that_comes_to_half_of_its_samples():
    (found,) = evenness(samples([20] * 75, period_ms=20), OWN)
    assert found.verdict is Verdict.LOOK
    assert "50 times a second" in found.found


@pytest.mark.parametrize("jump_s", [-3.0, 0.5])
def test_a_clock_that_jumps(jump_s):
    (found,) = evenness(samples([20] * 150, jump_ns=lambda i: round(jump_s * 1e9) * (i > 70)), OWN)
    assert found.verdict is Verdict.LOOK
    assert f"jumped by {abs(jump_s):.2f} s" in found.found


def test_samples_that_came_late_together_are_no_clock_that_jumped():
    (found,) = evenness(samples([20] * 60 + [20 + 10 * (20 - i) for i in range(20)] + [20] * 70), OWN)
    assert "jumped" not in found.found


def test_too_few_samples_say_nothing():
    (found,) = evenness(samples([20] * 5), OWN)
    assert found.verdict is Verdict.LOOK
    assert "only 5" in found.found


@pytest.mark.parametrize(
    ("ahead_ms", "verdict", "said"),
    [
        (40, Verdict.OK, "0.0 s ahead of"),
        (-30_000, Verdict.LOOK, "30.0 s behind"),
        (600_000, Verdict.WRONG, "600.0 s ahead of"),
    ],
)
def test_the_time_of_day_is_compared_where_it_is_told(ahead_ms, verdict, said):
    told_ms = 1_800_000_000_000
    beat = Beat("kitchen", heartbeat("robot", publisher=AWAY, utc_ms=told_ms), told_ms + ahead_ms)
    found = time_of_day(beat, OWN)
    assert found.verdict is verdict
    assert said in found.found


def test_an_older_release_tells_none():
    found = time_of_day(Beat("kitchen", heartbeat("robot", publisher=AWAY), 1_800_000_000_000), OWN)
    assert found.verdict is Verdict.LOOK


def test_on_one_machine_there_is_one_clock():
    assert time_of_day(Beat("kitchen", heartbeat("robot", publisher=OWN), 0), OWN).verdict is Verdict.OK
