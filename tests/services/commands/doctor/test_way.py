"""Small samples a hundred times a second say whether a robot can be led this way."""

import pytest

from services.commands.doctor.finding import Verdict
from services.commands.doctor.way import SAMPLES, Crossing, judged

MS = 1_000_000
SENT = [i * 10 * MS for i in range(SAMPLES)]


def crossing(trip_ms, lost=(), sent=SENT):
    """Every sample comes after so long, but for those that are lost."""
    trip = trip_ms if callable(trip_ms) else lambda i: trip_ms
    return Crossing(sent, [(s, s + round(trip(i) * MS)) for i, s in enumerate(sent) if i not in lost])


def test_a_short_and_whole_way():
    found = judged(crossing(12.0))
    assert found.verdict is Verdict.OK
    assert "in 12.0 ms" in found.found
    assert "none lost" in found.found
    assert "at most 10 ms of silence" in found.found


def test_single_samples_that_are_lost_are_made_up_for():
    assert judged(crossing(12.0, lost=(50, 120))).verdict is Verdict.OK


def test_many_that_are_lost_are_to_be_looked_at():
    found = judged(crossing(12.0, lost=range(0, SAMPLES, 10)))
    assert found.verdict is Verdict.LOOK
    assert "20 of 200 lost" in found.found


def test_a_silence_at_which_a_robot_holds_is_wrong():
    found = judged(crossing(12.0, lost=range(80, 92)))
    assert found.verdict is Verdict.WRONG
    assert "130 ms of silence" in found.found
    assert "beyond 100 ms a robot holds" in found.remedy


def test_a_link_that_is_cut_meanwhile_falls_silent():
    assert judged(crossing(12.0, lost=range(150, SAMPLES))).verdict is Verdict.WRONG
    assert judged(crossing(12.0, lost=range(30))).verdict is Verdict.WRONG


def test_a_machine_that_did_not_send_says_so_itself():
    paused = [s + (150 * MS if i >= 100 else 0) for i, s in enumerate(SENT)]
    found = judged(crossing(12.0, sent=paused))
    assert found.verdict is Verdict.LOOK
    assert "this machine itself paused for 160 ms" in found.found


@pytest.mark.parametrize(("trip_ms", "verdict"), [(120.0, Verdict.LOOK), (700.0, Verdict.WRONG)])
def test_a_long_way_is_felt_and_one_that_is_too_long_moves_nothing(trip_ms, verdict):
    assert judged(crossing(trip_ms)).verdict is verdict


def test_one_of_fifty_that_takes_long_is_told():
    found = judged(crossing(lambda i: 80.0 if i % 20 == 0 else 12.0))
    assert "49 of 50 within 80.0 ms" in found.found


def test_what_came_too_late_for_a_robot_is_lost():
    """It judges by the fastest: it does not know how long the way is."""
    found = judged(crossing(lambda i: 412.0 if i % 20 == 0 else 311.0, lost=range(5, SAMPLES, 50)))
    assert "14 of 200 lost (10 too late)" in found.found
    assert "14 of 200" not in judged(crossing(lambda i: 405.0 if i % 20 == 0 else 311.0)).found


@pytest.mark.parametrize("came", [[], [(0, MS)]])
def test_nothing_that_comes_back_is_wrong(came):
    assert judged(Crossing(SENT, came)).verdict is Verdict.WRONG


@pytest.mark.parametrize(
    "crossed", [crossing(12.0, lost=range(80, 92)), crossing(12.0, lost=range(0, SAMPLES, 10)), crossing(260.0)]
)
@pytest.mark.parametrize("whose", ["is_busy", "is_loopback"])
def test_what_a_computer_is_late_with_itself_is_blamed_on_no_cable(crossed, whose):
    found, of_the_way = judged(crossed, **{whose: True}), judged(crossed)
    assert "cable" in of_the_way.remedy
    assert "cable" not in found.remedy
    assert "this computer" in found.remedy
    assert found.verdict is (Verdict.LOOK if whose == "is_busy" else of_the_way.verdict)


def test_where_nothing_comes_back_a_busy_computer_may_be_the_cause():
    assert "this computer" in judged(crossing(12.0, lost=range(SAMPLES)), is_busy=True).remedy


def test_a_way_that_is_well_is_well_on_a_busy_computer_too():
    assert judged(crossing(12.0), is_busy=True, is_loopback=True) == judged(crossing(12.0))
