"""The laws of the operator's input: what counts, and for how long."""

import pytest
from browser_tab import MS, BrowserTab
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import Controller, OperatorInput
from services.station.page.input import Desk
from services.station.page.said import MAX_BYTES

DEAD_MAN_MS = 150
SHORT_MS = 500
HEARD_MS = 1_000
SETTLED_S = 1.0
BEATS = 3
NOTHING = OperatorInput()
LATE = OperatorInput(late=True)
PAD = Controller("gamepad", 1, "Some pad", True, (-1.0, 0.4), (0.0, 1.0))


@pytest.fixture
def browser():
    """A tab that has the seat, with nothing held."""
    tab = BrowserTab(Desk())
    tab.hold()
    return tab


def test_at_a_desk_where_nobody_sits_nothing_is_held_and_nobody_is_present():
    desk = Desk()
    assert desk.take_input(5_000 * MS) == NOTHING
    standing = desk.standing(1, 5_000 * MS)
    assert (standing.armed, standing.let_go, standing.focused, standing.accepted) == (False, True, False, ())


def test_the_full_state_arrives(browser):
    browser.hold("KeyE", "KeyQ", controllers=(PAD,))
    assert browser.input() == OperatorInput(keys=("KeyE", "KeyQ"), focused=True, controllers=(PAD,))


def test_every_state_replaces_the_one_before(browser):
    browser.hold("KeyE")
    browser.hold("KeyQ")
    assert browser.input().keys == ("KeyQ",)


def test_what_is_pressed_let_go_or_left_calls_and_what_stays_as_it_was_does_not(browser):
    for state, calls in (
        ({"keys": ("KeyE",)}, True),
        ({"keys": ("KeyE",)}, False),
        ({"keys": ()}, True),
        ({"keys": (), "focused": False}, True),
        ({"keys": (), "focused": False}, False),
    ):
        browser.desk.call.clear()
        browser.hold(*state["keys"], focused=state.get("focused", True))
        assert browser.desk.call.is_set() is calls


@pytest.mark.parametrize("action", ["stop", "execute"])
def test_a_press_calls(browser, action):
    browser.desk.call.clear()
    browser.press(action)
    assert browser.desk.call.is_set()


def test_silence_longer_than_the_dead_man_time_is_zero(browser):
    browser.hold("KeyE")
    assert browser.input(DEAD_MAN_MS).keys == ("KeyE",)
    assert browser.input(DEAD_MAN_MS + 1) == LATE
    assert browser.input(SHORT_MS) == LATE
    assert browser.input(SHORT_MS + 1) == NOTHING


def test_after_a_longer_silence_nobody_is_at_the_keys_until_they_were_let_go(browser):
    browser.hold("KeyE")
    browser.hold("KeyE", later_ms=SHORT_MS + 1)
    browser.hold("KeyE")
    assert browser.input() == NOTHING
    assert browser.standing().let_go
    assert browser.standing().focused
    assert browser.standing().heard
    assert not browser.standing(DEAD_MAN_MS + 1).heard
    browser.hold()
    assert browser.input() == OperatorInput(focused=True)
    assert not browser.standing().let_go
    browser.hold("KeyE")
    assert browser.input().keys == ("KeyE",)


def test_samples_that_come_in_time_are_no_silence(browser):
    browser.hold("KeyE", later_ms=DEAD_MAN_MS)
    browser.hold("KeyE", later_ms=DEAD_MAN_MS)
    assert browser.input().keys == ("KeyE",)


@pytest.mark.parametrize("lost", [{"focused": False}, {"visible": False}])
def test_without_the_focus_or_out_of_sight_nothing_counts_until_everything_was_let_go(browser, lost):
    browser.hold("KeyE", **lost)
    assert browser.input() == NOTHING
    browser.hold("KeyE")
    assert browser.input() == NOTHING
    browser.hold()
    browser.hold("KeyE")
    assert browser.input().keys == ("KeyE",)


def test_a_tab_that_opens_with_a_key_down_has_to_let_go_first():
    browser = BrowserTab(Desk())
    browser.hold("KeyE")
    assert browser.input() == NOTHING


@pytest.mark.parametrize("state", [{"controllers": (PAD,)}, {"keys": ("F13", "ControlLeft")}])
def test_what_steers_nothing_keeps_nobody_waiting(state):
    browser = BrowserTab(Desk())
    browser.hold(*state.get("keys", ()), controllers=state.get("controllers", ()))
    browser.hold("KeyE")
    assert browser.input().keys == ("KeyE",)


@pytest.mark.parametrize("key", ["KeyQ", "KeyD", "KeyR", "KeyH"])
def test_every_key_that_steers_has_to_be_let_go(key):
    browser = BrowserTab(Desk())
    browser.hold(key)
    assert browser.input() == NOTHING


def test_a_sample_that_was_under_way_for_too_long_does_not_count(browser):
    sent_ms = browser.now_ms
    browser.hold("KeyE", later_ms=DEAD_MAN_MS - 10, stamp_ms=sent_ms)
    assert browser.input().keys == ("KeyE",)
    browser.hold("KeyQ", later_ms=DEAD_MAN_MS - 10, stamp_ms=sent_ms + 1)
    assert browser.input().keys == ("KeyE",)
    assert browser.desk.late == 1


def test_a_repeated_sample_does_not_keep_the_input_alive(browser):
    browser.hold("KeyE")
    browser.sequence -= 1
    browser.hold("KeyE", later_ms=DEAD_MAN_MS - 50)
    assert browser.input(51) == LATE


def test_a_page_that_is_seen_and_heard_for_a_second_has_somebody_present(browser):
    browser.keep_on(SETTLED_S - 0.06)
    assert not browser.input().present
    browser.keep_on(0.04)
    assert browser.input().present


def test_nobody_is_present_once_the_page_was_not_heard_for_a_second(browser):
    browser.keep_on(2.0)
    since_the_beats_ms = 20 * (BEATS - 1)
    assert browser.input(HEARD_MS - since_the_beats_ms).present
    assert not browser.input(HEARD_MS - since_the_beats_ms + 1).present


def test_nobody_is_present_at_a_page_that_is_not_seen(browser):
    browser.keep_on(2.0)
    browser.hold(visible=False)
    assert not browser.input().present
    browser.keep_on(0.04)
    assert not browser.input().present
    browser.hold()
    assert browser.input().present


def test_a_page_without_the_focus_is_seen_all_the_same(browser):
    browser.keep_on(2.0, focused=False)
    assert browser.input() == OperatorInput(present=True)


def test_a_throttled_page_is_nobody_s_presence(browser):
    for _ in range(5):
        browser.hold(later_ms=1_000)
        assert not browser.input().present


def test_samples_of_a_while_ago_are_nobody_s_presence(browser):
    browser.keep_on(2.0)
    sent_ms = browser.now_ms
    browser.now_ms += 1_500
    for sample in range(20):
        browser.hold(later_ms=1, stamp_ms=sent_ms + 20 * sample)
    assert not browser.input().present


def test_presence_does_not_outlive_the_tab(browser):
    browser.keep_on(2.0)
    browser.leave()
    assert browser.input() == NOTHING


def test_a_page_that_comes_back_resumes_nothing(browser):
    browser.keep_on(2.0)
    browser.leave()
    again = BrowserTab(browser.desk, tab=2, now_ms=browser.now_ms + 300, token="seat-0001")
    again.keep_on(SETTLED_S - 0.02)
    assert again.standing().armed
    assert not again.input().present
    again.keep_on(0.04)
    assert again.input().present


def test_after_its_computer_has_slept_a_tab_counts_again_within_two_seconds(browser):
    browser.keep_on(2.0)
    behind_ms = 60_000
    browser.now_ms += behind_ms
    for _ in range(90):
        browser.hold(stamp_ms=browser.now_ms + 20 - behind_ms)
    browser.hold("KeyE", stamp_ms=browser.now_ms + 20 - behind_ms)
    assert browser.input().keys == ("KeyE",)


@pytest.mark.parametrize(
    "payload",
    [
        "",
        "[" * 4_000,
        "x" * (MAX_BYTES + 1),
        '{"kind":"held"}',
        '{"kind":"hello","seat":"short","load":"abcdefgh"}',
        '{"kind":"pressed","sequence":9,"stamp_ms":9,"number":1,"action":"<script>"}',
        '{"kind":"pressed","sequence":9,"stamp_ms":9,"number":1,"action":"stop","extra":1}',
        '{"kind":"held","sequence":9,"stamp_ms":9,"keys":[],"visible":true,"focused":true,"controllers":[2],"drawn":[0,0,0,0]}',
        '{"kind":"held","sequence":9,"stamp_ms":NaN,"keys":[],"visible":true,"focused":true,"controllers":[],"drawn":[0,0,0,0]}',
        '{"kind":"held","sequence":9,"stamp_ms":1,"keys":["+"],"visible":true,"focused":true,"controllers":[],"drawn":[0,0,0,0]}',
    ],
)
def test_garbage_is_dropped_and_counted_and_changes_nothing(browser, payload):
    browser.hold("KeyE")
    assert browser.desk.receive(1, payload, browser.now_ms * MS) is None
    assert browser.desk.dropped == 1
    assert browser.input().keys == ("KeyE",)
    assert browser.desk.take_presses() == []


@given(st.binary(max_size=300))
def test_no_bytes_break_the_desk(payload):
    desk = Desk()
    assert desk.receive(1, payload, 0) is None
    assert desk.dropped == 1


def test_when_the_browser_read_what_is_held_is_known_by_its_round_trips(browser):
    """Half of the fastest is the way; what comes later than the fastest was under way for so much longer."""
    browser.hold("KeyE", way_ms=3.0)
    assert browser.now_ms * MS - browser.input().captured_ns == 3 * MS
    browser.hold("KeyE", "KeyQ", way_ms=3.0, waited_ms=1.5)
    assert browser.now_ms * MS - browser.input().captured_ns == 4.5 * MS
    browser.hold("KeyE", way_ms=3.0, later_ms=60, stamp_ms=browser.now_ms + 20)
    assert browser.now_ms * MS - browser.input().captured_ns == pytest.approx(43 * MS, rel=2e-3), "clocks may drift"


def test_before_any_round_trip_nobody_knows_when(browser):
    browser.hold("KeyE")
    assert browser.input().captured_ns == 0


def test_how_old_a_picture_was_when_it_had_been_drawn_is_passed_on(browser):
    browser.hold()
    assert browser.input().drawn == -1.0
    browser.hold(picture_ms=31.0)
    assert browser.input().drawn == pytest.approx(0.031)
    assert browser.input(later_ms=DEAD_MAN_MS + 1).drawn == pytest.approx(0.031), "whatever of its keys counts"
    browser.leave()
    assert browser.input().drawn == -1.0
