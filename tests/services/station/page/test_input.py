"""The laws of the operator's input: what counts, from whom, and for how long."""

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import OperatorInput
from services.station.page.input import ACTIONS_KEPT, DEAD_MAN_NS, MAX_BYTES, Desk, Held, Pressed, TakeInput

MS = 1_000_000
NOTHING = OperatorInput()


class Browser:
    """A tab that says what is held, on a clock that the test moves."""

    def __init__(self, desk, tab=1, now_ms=1_000):
        self.desk = desk
        self.tab = tab
        self.now_ms = now_ms
        self.sequence = 0
        desk.join(tab, now_ms * MS)

    def hold(self, *keys, focused=True, axes=(), later_ms=20, stamp_ms=None):
        self.now_ms += later_ms
        self.sequence += 1
        stamp = self.now_ms if stamp_ms is None else stamp_ms
        self.send(Held(self.sequence, float(stamp), keys, focused, axes, (0, 0)))

    def send(self, message):
        self.desk.receive(self.tab, msgspec.json.encode(message), self.now_ms * MS)

    def input(self, later_ms=0):
        return self.desk.take_input((self.now_ms + later_ms) * MS)


def armed():
    browser = Browser(Desk())
    browser.hold()
    return browser


def test_the_full_state_arrives():
    browser = armed()
    browser.hold("KeyE", "KeyQ", axes=(0.5, -1.0))
    assert browser.input() == OperatorInput(keys=("KeyE", "KeyQ"), focused=True, axes=(0.5, -1.0))


def test_every_state_replaces_the_one_before():
    browser = armed()
    browser.hold("KeyE")
    browser.hold("KeyQ")
    assert browser.input().keys == ("KeyQ",)


def test_silence_longer_than_the_dead_man_time_is_zero():
    browser = armed()
    browser.hold("KeyE")
    assert browser.input(DEAD_MAN_NS // MS).keys == ("KeyE",)
    assert browser.input(DEAD_MAN_NS // MS + 1) == NOTHING


def test_after_silence_a_held_key_counts_again_only_once_everything_was_let_go():
    browser = armed()
    browser.hold("KeyE")
    browser.hold("KeyE", later_ms=200)
    assert browser.input().keys == ()
    browser.hold()
    browser.hold("KeyE")
    assert browser.input().keys == ("KeyE",)


def test_a_deflected_axis_is_something_held_as_well():
    browser = armed()
    browser.hold(axes=(0.4,), later_ms=200)
    assert browser.input().axes == ()
    browser.hold(axes=(0.0,))
    browser.hold(axes=(0.4,))
    assert browser.input().axes == (0.4,)


def test_without_the_focus_nothing_counts_until_everything_was_let_go():
    browser = armed()
    browser.hold("KeyE", focused=False)
    assert browser.input() == NOTHING
    browser.hold("KeyE")
    assert browser.input() == OperatorInput(focused=True)


def test_a_tab_that_opens_with_a_key_down_has_to_let_go_first():
    browser = Browser(Desk())
    browser.hold("KeyE")
    assert browser.input().keys == ()


def test_a_sample_that_was_under_way_for_too_long_does_not_count():
    browser = armed()
    sent_ms = browser.now_ms
    browser.hold("KeyE", later_ms=140, stamp_ms=sent_ms)
    assert browser.input().keys == ("KeyE",)
    browser.hold("KeyQ", later_ms=140, stamp_ms=sent_ms + 1)
    assert browser.input().keys == ("KeyE",)
    assert browser.desk.late == 1


def test_a_repeated_sample_does_not_keep_the_input_alive():
    browser = armed()
    browser.hold("KeyE")
    browser.sequence -= 1
    browser.hold("KeyE", later_ms=100)
    assert browser.input(60) == NOTHING


def test_one_tab_commands_and_the_others_look_on():
    first = armed()
    second = Browser(first.desk, tab=2, now_ms=first.now_ms)
    second.hold()
    second.hold("KeyQ")
    first.hold("KeyE", later_ms=40)
    assert first.input().keys == ("KeyE",)
    assert first.desk.standing(1, first.now_ms * MS).armed
    assert not first.desk.standing(2, first.now_ms * MS).armed


def test_taking_the_input_disarms_the_other_tab_at_once():
    first = armed()
    first.hold("KeyE")
    second = Browser(first.desk, tab=2, now_ms=first.now_ms)
    second.send(TakeInput())
    assert first.input() == NOTHING
    second.hold()
    second.hold("KeyQ")
    first.hold("KeyE", later_ms=45)
    assert second.input().keys == ("KeyQ",)


def test_a_closed_tab_leaves_nothing_behind_and_nobody_inherits_its_input():
    first = armed()
    second = Browser(first.desk, tab=2, now_ms=first.now_ms)
    first.hold("KeyE")
    first.desk.leave(1)
    second.hold()
    second.hold("KeyQ")
    assert first.input() == NOTHING
    assert second.input() == NOTHING


def test_a_new_tab_takes_the_input_from_one_that_fell_silent():
    first = armed()
    second = Browser(first.desk, tab=2, now_ms=first.now_ms + 1_001)
    second.hold()
    second.hold("KeyQ")
    assert second.input().keys == ("KeyQ",)


def test_buttons_arrive_once_and_in_order():
    browser = armed()
    for action in ("execute", "undo"):
        browser.send(Pressed(action))
    assert browser.desk.take_actions() == ["execute", "undo"]
    assert browser.desk.take_actions() == []


def test_a_tab_that_looks_on_may_stop_the_robot_and_nothing_else():
    first = armed()
    second = Browser(first.desk, tab=2, now_ms=first.now_ms)
    second.send(Pressed("execute"))
    second.send(Pressed("stop"))
    assert first.desk.take_actions() == ["stop"]


def test_a_stop_gets_through_where_too_many_buttons_wait():
    browser = armed()
    for _ in range(2 * ACTIONS_KEPT):
        browser.send(Pressed("execute"))
    browser.send(Pressed("stop"))
    assert browser.desk.take_actions() == ["execute"] * ACTIONS_KEPT + ["stop"]


@pytest.mark.parametrize(
    "payload",
    [
        "",
        "[" * 4_000,
        "x" * (MAX_BYTES + 1),
        '{"kind":"held"}',
        '{"kind":"pressed","action":"<script>"}',
        '{"kind":"pressed","action":"stop","extra":1}',
        '{"kind":"held","sequence":9,"stamp_ms":9,"keys":["KeyE"],"focused":true,"axes":[2],"drawn":[0,0]}',
        '{"kind":"held","sequence":9,"stamp_ms":NaN,"keys":["KeyE"],"focused":true,"axes":[],"drawn":[0,0]}',
        '{"kind":"held","sequence":9,"stamp_ms":9,"keys":["Key E"],"focused":true,"axes":[],"drawn":[0,0]}',
    ],
)
def test_garbage_is_dropped_and_counted_and_changes_nothing(payload):
    browser = armed()
    browser.hold("KeyE")
    assert browser.desk.receive(1, payload, browser.now_ms * MS) is None
    assert browser.desk.dropped == 1
    assert browser.input().keys == ("KeyE",)
    assert browser.desk.take_actions() == []


@given(st.binary(max_size=300))
def test_no_bytes_break_the_desk(payload):
    desk = Desk()
    desk.join(1, 0)
    assert desk.receive(1, payload, 0) is None
    assert desk.dropped == 1
