"""The benchmark of one message's way: what it reckons, and that each way carries what is sent."""

import numpy as np
import pytest

from protocol import topics
from protocol.codec import decode
from services.certificates.authority import make_authority
from tests.bench import transport
from tests.bench.wire.way import CARRIERS, Burst, Way, payload

RAW, OURS, BARE, _, TCP, *_ = CARRIERS


class Named:
    """A way, as far as a table names it."""

    about = "the bus"


def burst(latency_us, sent=100, came=100):
    return Burst(np.full(came, float(latency_us)), sent, 0)


def test_a_ratio_is_taken_within_each_round_so_that_a_slow_round_changes_nothing():
    own, raw = [burst(120), burst(12_000), burst(120)], [burst(100), burst(10_000), burst(100)]
    one = transport.carried(transport.CASES[0], Named, own, raw)
    assert one.ratio == one.ratio_p99 == pytest.approx(1.2)
    assert one.value == 120.0


def test_what_does_not_come_is_lost():
    one = transport.carried(transport.CASES[0], Named, [burst(1, came=75), burst(1)], [burst(1), burst(1)])
    assert one.lost == pytest.approx(0.125)


@pytest.mark.parametrize(("ratio", "met"), [(1.3, True), (1.31, False)])
def test_the_bus_has_a_goal_and_nobody_else(ratio, met):
    ours = transport.carried(transport.CASES[0], Named, [burst(100.0 * ratio)], [burst(100.0)])
    other = transport.Carried("pyzmq", 1.0, "us", case=ours.case, ratio=9.0)
    assert [one.met for one in transport.goals([other, ours])] == [met, met]


def test_what_all_carry_is_a_state_of_a_master():
    assert decode(topics.MASTER_STATE, payload()).engaged


@pytest.mark.zenoh
@pytest.mark.parametrize("secure", [False, True], ids=["clear", "tls"])
@pytest.mark.parametrize("carrier", [RAW, OURS, BARE, TCP], ids=lambda carrier: carrier.name)
def test_each_way_carries_commands_and_pictures(carrier, secure, tmp_path):
    certificates = None
    if secure:
        authority = make_authority(tmp_path / "certs")
        for name in transport.NAMES:
            authority.issue(name)
        certificates = authority.folder
    with Way(carrier, certificates) as way:
        came = way.burst(50.0, 0.4, pictures=True)
        assert came.pictures > 0
        assert 0 < len(came.latencies_us) <= came.sent
        assert came.latencies_us.min() > 0.0
        assert way.burst(50.0, 0.2, pictures=False).pictures == 0
