"""What each role may do at the desk: operators one at a time, observers and supervisors never steer, all may stop."""

import pytest
from browser_tab import BrowserTab
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import OperatorInput, Person, Role, TakeOver
from services.station.page.input import Desk
from services.station.press import Press

ASKED_MS = 10_000
NUMBERS = {"operator": 2, "observer": 3, "supervisor": 4}


@pytest.fixture
def ann():
    """An operator who has the input."""
    tab = BrowserTab(Desk("ann"))
    tab.keep_on(2.0)
    return tab


def comes(ann, role, name):
    """Somebody opens another tab."""
    tab = BrowserTab(ann.desk, tab=NUMBERS[role], now_ms=ann.now_ms, role=role, name=name)
    tab.hold()
    ann.now_ms = tab.now_ms
    ann.hold()
    return tab


def people(desk):
    return desk.attendance().people


def test_everybody_is_there_by_name_and_role_and_gone_once_the_tab_is(ann):
    others = [comes(ann, role, name) for role, name in zip(NUMBERS, ("bob", "carl", "eve"), strict=True)]
    assert people(ann.desk) == (
        Person("ann", Role.OPERATOR, has_input=True),
        Person("bob", Role.OPERATOR),
        Person("carl", Role.OBSERVER),
        Person("eve", Role.SUPERVISOR),
    )
    for tab in others:
        tab.leave()
    assert people(ann.desk) == (Person("ann", Role.OPERATOR, has_input=True),)


@pytest.mark.parametrize("role", ["observer", "supervisor"])
def test_who_looks_on_never_gets_the_input_even_where_nobody_has_it(role):
    tab = BrowserTab(Desk("ann"), role=role)
    tab.keep_on(2.0)
    for action in ("take_input", "seize_input", "give_input", "execute", "finish", "revoke"):
        tab.press(action, argument="because")
    assert not tab.standing().armed
    assert tab.input() == OperatorInput()
    assert tab.desk.take_presses() == []
    later = BrowserTab(tab.desk, tab=9, now_ms=tab.now_ms, token="seat-0009")
    assert later.standing().armed


@pytest.mark.parametrize("role", ["observer", "supervisor"])
def test_the_keys_of_who_looks_on_do_nothing(ann, role):
    tab = comes(ann, role, "carl")
    tab.hold("KeyQ")
    assert ann.input().keys == ()


@pytest.mark.parametrize("role", NUMBERS)
def test_everybody_may_stop_and_is_named(ann, role):
    tab = comes(ann, role, "carl")
    tab.press("stop")
    assert ann.desk.take_presses() == [Press("stop", by="carl")]
    assert tab.standing().accepted == (1,)


def test_a_supervisor_with_a_name_revokes_and_nobody_else(ann):
    supervisor = comes(ann, "supervisor", "")
    for tab in (ann, comes(ann, "observer", "carl"), comes(ann, "operator", "bob"), supervisor):
        tab.press("revoke", argument="it is late")
        assert tab.standing().refused == (1,)
    assert ann.desk.take_presses() == []
    supervisor.says("supervisor", "eve")
    supervisor.press("revoke", argument="it is late")
    assert ann.desk.take_presses() == [Press("revoke", "it is late", "eve")]


def test_whoever_sits_is_the_operator_of_what_is_held(ann):
    bob = comes(ann, "operator", "bob")
    assert ann.input().operator == "ann"
    bob.press("take_input")
    assert ann.standing().asked_by == "bob"
    assert bob.standing().asked_by == ""
    ann.press("give_input")
    bob.keep_on(1.1)
    assert bob.input() == OperatorInput(operator="bob", present=True, focused=True)


def test_a_second_operator_takes_the_input_at_once_and_who_loses_it_is_told_why(ann, caplog):
    bob = comes(ann, "operator", "bob")
    ann.hold("KeyE")
    bob.press("seize_input", argument=" she\nleft ")
    assert bob.standing().armed
    assert bob.standing().lost is None
    assert ann.standing().lost == TakeOver("bob", "ann", "she\nleft")
    assert bob.input() == OperatorInput(operator="bob")
    assert bob.desk.attendance().taken == TakeOver("bob", "ann", "she\nleft")
    (record,) = caplog.records
    assert record.getMessage() == "ann's input was taken over by bob: she left"


@pytest.mark.parametrize("reason", ["", "  ", "ok"])
def test_without_a_reason_nothing_is_taken(ann, reason):
    bob = comes(ann, "operator", "bob")
    bob.press("seize_input", argument=reason)
    assert ann.standing().armed
    assert bob.standing().refused == (1,)
    assert bob.desk.attendance().taken is None


def test_who_has_the_input_takes_it_from_nobody(ann):
    ann.hold("KeyE")
    ann.press("seize_input", argument="because")
    assert ann.input().keys == ("KeyE",)
    assert ann.desk.attendance().taken is None


def test_who_lost_the_input_is_told_after_a_reload_too(ann):
    comes(ann, "operator", "bob").press("seize_input", argument="she left")
    ann.leave()
    again = BrowserTab(ann.desk, tab=7, now_ms=ann.now_ms, token="seat-0001")
    assert again.standing().lost == TakeOver("bob", "ann", "she left")


def test_an_operator_who_becomes_an_observer_gives_the_input_up_and_a_press_takes_it_at_once(ann):
    bob = comes(ann, "operator", "bob")
    ann.hold("KeyE")
    ann.says("observer", "ann")
    assert not ann.standing().armed
    assert ann.input() == OperatorInput()
    bob.now_ms = ann.now_ms
    bob.press("take_input")
    assert bob.standing().armed


def test_who_asks_gets_the_input_of_an_operator_who_becomes_an_observer(ann):
    bob = comes(ann, "operator", "bob")
    bob.press("take_input")
    ann.says("observer", "ann")
    assert bob.standing().armed


def test_an_operator_who_asks_and_becomes_an_observer_gets_nothing(ann):
    bob = comes(ann, "operator", "bob")
    bob.press("take_input")
    bob.says("observer", "bob")
    ann.keep_on(ASKED_MS / 1e3 + 0.1)
    assert ann.standing().armed


def test_another_name_of_who_sits_resumes_nothing(ann):
    ann.hold("KeyE")
    ann.says("operator", "anna")
    assert ann.standing().armed
    assert ann.input() == OperatorInput(operator="anna")


def test_a_second_operator_is_as_dead_as_the_first_once_silent(ann):
    bob = comes(ann, "operator", "bob")
    bob.press("seize_input", argument="she left")
    bob.keep_on(2.0)
    bob.hold("KeyQ")
    assert bob.input().keys == ("KeyQ",)
    assert bob.input(151).keys == ()
    assert not bob.input(1_100).present
    bob.hold(visible=False)
    assert not bob.input().present


STEPS = st.lists(
    st.tuples(
        st.sampled_from([0, 1, 2]),
        st.sampled_from(["take_input", "seize_input", "give_input", "keep_input", "hold", "leave", *NUMBERS]),
        st.sampled_from([20, 5_000, 11_000, 40_000]),
    ),
    max_size=30,
)


@given(STEPS)
def test_one_operator_has_the_input_at_most_and_never_anybody_else(steps):
    """Whatever people do: who has the input is an operator who is there, and got it by coming first or by a press."""
    desk, now_ms = Desk("ann"), 5_000
    tabs = [BrowserTab(desk, tab=tab, now_ms=now_ms, token=f"seat-000{tab}", name=f"n{tab}") for tab in (1, 2, 3)]
    for which, what, later_ms in steps:
        now_ms += later_ms
        tab = tabs[which]
        tab.now_ms = now_ms
        if what == "hold":
            tab.hold("KeyE")
        elif what == "leave":
            tab.leave()
        elif what in NUMBERS:
            tab.says(what, f"n{tab.tab}")
        else:
            tab.press(what, argument="because")
        now_ms = tab.now_ms
        armed = [one for one in tabs if one.standing().armed]
        seated = [person for person in desk.attendance().people if person.has_input]
        assert len(armed) <= 1
        assert [person.name for person in seated] == [f"n{one.tab}" for one in armed]
        assert all(person.role is Role.OPERATOR for person in seated)
        assert bool(desk.take_input(now_ms * 1_000_000).keys) <= bool(armed)
