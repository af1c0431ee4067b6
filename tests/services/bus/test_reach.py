"""Who listens is told from who does not, and how long a link may take to open follows the way there."""

import socket

import pytest

from services.bus import reach
from services.bus.reach import OPEN_LEAST_MS, OPEN_MOST_MS, UNMEASURED_S, Silence, fits, open_timeout_ms, probe
from services.process.endpoint import parse
from services.process.exceptions import BadEndpoint


def test_a_listener_with_tls_is_not_dialled_to_measure_the_way():
    assert probe(parse("tls/127.0.0.1:1")) == UNMEASURED_S
    assert fits(open_timeout_ms(UNMEASURED_S), UNMEASURED_S)


def test_somebody_who_listens_is_reached():
    with socket.create_server(("127.0.0.1", 0)) as server:
        assert isinstance(probe(parse(f"tcp/127.0.0.1:{server.getsockname()[1]}")), float)


@pytest.fixture
def way(monkeypatch):
    """Where every trip takes as long as a test says, in turn; an error is one that fails."""

    def says(*trips):
        turn = iter(trips)
        passed = [0.0]

        def race(_):
            trip = next(turn)
            if isinstance(trip, OSError):
                raise trip
            passed[0] += trip
            return trip

        monkeypatch.setattr(reach, "_race", race)
        monkeypatch.setattr(reach.time, "monotonic", lambda: passed[0])
        return probe(parse("tcp/127.0.0.1:7447"))

    return says


def test_the_shortest_trip_counts_for_a_busy_machine_makes_single_ones_long(way):
    assert way(0.13, 0.02, 0.004, 0.03, 0.02) == 0.004


def test_a_packet_that_was_sent_again_makes_no_long_way(way):
    """The link came back after the first packet was lost: it was sent again a second later."""
    assert way(1.01, 0.004, 0.004, 0.004, 0.004) == 0.004


def test_a_long_way_is_not_measured_for_long(way):
    assert way(0.6, 0.5) == 0.5


def test_a_trip_that_fails_after_one_that_did_not_takes_nothing_back(way):
    lost = TimeoutError("no answer")
    assert way(0.01, lost, lost, lost, lost) == 0.01
    assert way(lost) == Silence("no answer")


def test_a_port_where_nobody_listens_is_waited_for_with_its_reason():
    with socket.socket() as bound:
        bound.bind(("127.0.0.1", 0))
        assert probe(parse(f"tcp/127.0.0.1:{bound.getsockname()[1]}")) == Silence("connection refused")


@pytest.mark.parametrize(
    "error", [socket.gaierror(socket.EAI_NONAME, "Name or service not known"), UnicodeError("label too long")]
)
def test_a_host_that_nobody_knows_is_no_endpoint(monkeypatch, error):
    monkeypatch.setattr(reach.socket, "getaddrinfo", failing(error))
    with pytest.raises(BadEndpoint, match="'robot' is not known") as caught:
        probe(parse("tls/robot:7447"))
    assert caught.value.right == "tls/192.0.2.1:7447"


def test_a_network_that_is_not_up_yet_is_waited_for(monkeypatch):
    monkeypatch.setattr(reach.socket, "getaddrinfo", failing(socket.gaierror(socket.EAI_AGAIN, "try again")))
    assert probe(parse("tcp/robot:7447")) == Silence("no name server answers")


def test_a_link_may_take_longer_to_open_where_the_way_is_long():
    assert open_timeout_ms(0.0) == OPEN_LEAST_MS
    assert OPEN_LEAST_MS + 3 * 600 < open_timeout_ms(0.6) < OPEN_MOST_MS
    assert open_timeout_ms(60.0) == OPEN_MOST_MS


@pytest.mark.parametrize("trip", [0.0, 0.001, 0.05, 0.6])
def test_the_pace_of_a_way_fits_it_and_that_of_another_does_not(trip):
    pace = open_timeout_ms(trip)
    assert fits(pace, trip)
    assert not fits(pace, trip + pace / 3e3), "three round trips, and it is given up before they are made"
    assert not fits(open_timeout_ms(2 * trip + 0.1), trip), "a cut link would be dialled too late"


def failing(error):
    def fail(*_, **__):
        raise error

    return fail
