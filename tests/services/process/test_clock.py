"""The machine's clock goes on while the machine sleeps, and all processes share it."""

import threading
import time

from services.process.clock import CLOCK, SystemClock


def test_it_is_the_clock_that_counts_sleep_where_there_is_one():
    assert getattr(time, "CLOCK_BOOTTIME", time.CLOCK_MONOTONIC) == CLOCK
    before = time.clock_gettime_ns(CLOCK)
    assert before <= SystemClock().now_ns() <= time.clock_gettime_ns(CLOCK)


def test_it_sleeps_until_the_deadline_and_not_at_all_past_it():
    clock = SystemClock()
    deadline = clock.now_ns() + 2_000_000
    clock.sleep_until(deadline, threading.Event())
    assert clock.now_ns() >= deadline
    clock.sleep_until(0, threading.Event())


def test_a_long_sleep_ends_when_it_is_to_stop():
    stop = threading.Event()
    stop.set()
    clock = SystemClock()
    hour = 3_600_000_000_000
    due = clock.now_ns() + hour
    clock.sleep_until(due, stop)
    assert clock.now_ns() < due


def test_what_calls_ends_the_wait_and_without_it_the_deadline_does():
    call, clock = threading.Event(), SystemClock()
    deadline = clock.now_ns() + 2_000_000
    assert not clock.wait_until(deadline, call)
    assert clock.now_ns() >= deadline
    call.set()
    assert clock.wait_until(clock.now_ns() + 3_600_000_000_000, call)
    assert clock.wait_until(0, call)
