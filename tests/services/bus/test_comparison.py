"""The edges of what is learnt about another machine's clock, to the nanosecond."""

import pytest

from services.bus.clocks import Clocks
from services.bus.identity import new_publisher

OWN = new_publisher()
OTHER_MACHINE = OWN ^ (1 << 50)
START = 10**18

DRIFT_PPM = 600
NEAR_NS = 100_000_000
RELEARN_NS = 1_000_000_000
LONG_NS = 100_000_000_000


def ages(*samples):
    """Of samples of another machine: how long each took, and when it came after the first one [ns]."""
    clocks = Clocks(OWN)
    return [clocks.age_ns(OTHER_MACHINE, START + came - took, START + came) for took, came in samples]


FORGOTTEN_NS = LONG_NS * DRIFT_PPM // 1_000_000
WITHIN_NS = NEAR_NS + FORGOTTEN_NS  # faster than the first one: near, and as far again as the clocks may have drifted


@pytest.mark.parametrize(
    ("silence_ns", "faster_ns", "at_once"),
    [(LONG_NS, WITHIN_NS, False), (LONG_NS + 1, WITHIN_NS, True), (LONG_NS + 1, WITHIN_NS + 1, False)],
)
def test_only_after_a_long_silence_is_a_much_faster_sample_believed_at_once(silence_ns, faster_ns, at_once):
    age = ages((0, 0), (-faster_ns, silence_ns))[-1]
    assert age == (0 if at_once else -faster_ns - FORGOTTEN_NS)


@pytest.mark.parametrize(("off_ns", "near"), [(0, True), (1, False)])
def test_how_near_a_sample_has_to_be_to_teach_the_baseline(off_ns, near):
    early = ages((0, 0), *[(-NEAR_NS - off_ns, 0)] * 3)
    assert early[-1] == (0 if near else -NEAR_NS - off_ns)
    drifted = RELEARN_NS * DRIFT_PPM // 1_000_000
    late = ages((0, 0), (NEAR_NS + off_ns, 0), (NEAR_NS + off_ns + drifted, RELEARN_NS))
    assert late[-1] == (NEAR_NS if near else drifted), "what is near is late, what is not was a clock"


@pytest.mark.parametrize(("apart_ns", "alike"), [(NEAR_NS, True), (NEAR_NS + 1, False)])
def test_samples_that_were_away_are_of_one_clock_where_they_are_as_alike_as_near_ones(apart_ns, alike):
    took = 10 * NEAR_NS
    age = ages((0, 0), (took, 0), (took + apart_ns, RELEARN_NS))[-1]
    assert (age == apart_ns) is alike


@pytest.mark.parametrize(("took_ns", "jumped"), [(2 * NEAR_NS, True), (2 * NEAR_NS - 1, False)])
def test_it_was_a_clock_where_half_of_it_came_from_one_sample_to_the_next_and_else_a_queue(took_ns, jumped):
    age = ages((0, 0), (NEAR_NS, 0), (took_ns, 0), (took_ns, RELEARN_NS))[-1]
    assert age == (0 if jumped else took_ns - RELEARN_NS * DRIFT_PPM // 1_000_000)
