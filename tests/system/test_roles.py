"""Two operators at two stations of one robot, with an observer and a supervisor, over a real network."""

import contextlib
import time

import pytest

from protocol import topics
from protocol.messages import Phase
from services.process.config import load
from tests.system.harness import START_S, Command, Witness, configured, eventually, free_endpoint
from tests.system.onlooker import Onlooker
from tests.system.somebody import Somebody

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

WITHIN_S = 20.0
MOVES_WITHIN_S = 60.0
HELD_WITHIN_S = 1.0
GONE_WITHIN_S = 2.0
TOLD_S = 0.15
"""The page is told ten times a second, and the attendance is said as often."""

MOVING = {"ramp", "execute"}


@pytest.fixture(scope="module")
def endpoint():
    return free_endpoint()


@pytest.fixture(scope="module")
def stations(tmp_path_factory, endpoint):
    """Ann's whole system and Bob's station beside it; the addresses of their pages."""
    folder = tmp_path_factory.mktemp("roles")
    pages = []
    with contextlib.ExitStack() as stack:
        for name, command in (("ann", "up"), ("bob", "station")):
            own = folder / name
            own.mkdir()
            configuration = configured(own, endpoint, station="autonomous_s = 20.0\n")
            with_operator = ("--operator", name, "--config", configuration, "--scene", "particle")
            arguments = ("--fresh", "--no-browser") if command == "up" else ("--connect", endpoint)
            stack.enter_context(Command(command, *with_operator, *arguments, folder=folder))
            station = load(configuration).station
            pages.append((station.host, station.port))
            if command == "up":
                with Witness(endpoint) as witness:
                    witness.next_beats({"robot", "model", "station-ann"}, START_S)
        with Witness(endpoint) as witness:
            witness.next_beats({"station-bob"}, START_S)
        yield pages


@pytest.fixture
def witness(stations, endpoint):
    with Witness(endpoint) as one:
        yield one


@pytest.fixture
def onlooker(stations, endpoint):
    with Onlooker(endpoint) as watching:
        yield watching


@pytest.fixture
def people(stations):
    """A function that lets somebody come to Ann's or Bob's page."""
    with contextlib.ExitStack() as stack:
        yield lambda page, name, role="": stack.enter_context(Somebody(*stations[page], name, role))


def commands(witness, name):
    """Wait until somebody commands, by the robot's own word."""
    eventually(
        lambda: witness.authority is not None and witness.authority.operator == name,
        WITHIN_S,
        lambda: f"{name} commands; {witness.authority}",
    )


def takes_over(witness, somebody, name, why):
    """Take over as a person does, whenever that is offered, until it is so by the robot's own word."""

    def taken():
        if somebody.shown.get("action-take_over@disabled") is False:
            somebody.shown["action-take_over@disabled"] = True  # until s/he is told otherwise
            somebody.press("take_over", why)
        return witness.authority is not None and witness.authority.operator == name

    eventually(taken, WITHIN_S, lambda: f"{name} commands; {witness.authority}, {somebody.shown}")


def shows(somebody, value, words):
    eventually(
        lambda: words in str(somebody.shown.get(value, "")), WITHIN_S, lambda: f"{words!r}; {somebody.shown.get(value)}"
    )


def moving(onlooker, ann):
    """A motion under way, asked for by Ann; where little is known of the place she is told so first, and asks again."""
    began = time.monotonic()

    def moves():
        if any(seen.phase == "execute" for seen in onlooker.since(began)):
            return True
        if ann.shown.get("action-execute@disabled") is False:
            ann.shown["action-execute@disabled"] = True  # until she is told otherwise
            ann.press("execute")
        return False

    eventually(moves, MOVES_WITHIN_S, lambda: f"it moves; {ann.shown}")


@pytest.fixture
def both(people, witness):
    """Ann commands, Bob is there."""
    ann, bob = people(0, "Ann"), people(1, "Bob")
    eventually(lambda: ann.armed and bob.armed, WITHIN_S, "both sit")

    def decided():
        """Ann commands, or may take over: whoever comes first to a robot that is free commands it."""
        return ann.shown.get("who-text") == "You command" or ann.shown.get("action-take_over@disabled") is False

    eventually(decided, WITHIN_S, lambda: ann.shown)
    takes_over(witness, ann, "Ann", "the test begins")
    shows(ann, "who-text", "You command")
    shows(bob, "who-text", "Ann commands")
    shows(bob, "action-ask@disabled", "False")
    return ann, bob


def test_a_second_operator_asks_and_the_first_keeps_and_gives(both, witness):
    ann, bob = both
    bob.press("ask")
    shows(ann, "robot-asked-text", "Bob asks for the robot")
    ann.press("keep_authority")
    eventually(lambda: witness.authority.kept_from, WITHIN_S, "it is kept")
    assert witness.authority.operator == "Ann"
    shows(bob, "action-ask@disabled", "False")
    bob.press("ask")
    shows(ann, "robot-asked-text", "Bob asks for the robot")
    ann.press("give_authority")
    commands(witness, "Bob")
    shows(bob, "who-text", "You command")
    shows(ann, "who-text", "Bob commands")


def test_silence_gives_the_robot(both, witness):
    ann, bob = both
    bob.press("ask")
    shows(ann, "robot-asked-text", "Bob asks for the robot")
    asked = time.monotonic()
    commands(witness, "Bob")
    assert time.monotonic() - asked > 8.0
    shows(ann, "who-text", "Bob commands")


def test_a_take_over_ends_the_motion_and_who_loses_the_robot_is_told_why(both, witness, onlooker):
    ann, bob = both
    moving(onlooker, ann)
    takes_over(witness, bob, "Bob", "a cup is in the way")
    state = witness.next(topics.AUTHORITY_STATE, lambda state: state.operator == "Bob")
    onlooker.until(lambda seen: seen.phase not in MOVING, WITHIN_S, "it stands")
    shows(ann, "who-text", "Bob commands")
    assert state.before == "Ann"
    eventually(
        lambda: any("a cup is in the way" in str(value) for value in ann.shown.values()), WITHIN_S, lambda: ann.shown
    )


def test_a_supervisor_ends_the_authority_and_the_robot_holds_at_once(both, people, witness, onlooker):
    ann, _ = both
    eve = people(1, "Eve", "supervisor")
    shows(ann, "people-supervising", "Eve")
    moving(onlooker, ann)
    eve.press("revoke", "the lab closes")
    state = witness.next(topics.AUTHORITY_STATE, lambda state: not state.holder, WITHIN_S)
    assert (state.by, state.before, state.reason) == ("Eve", "Ann", "the lab closes")
    onlooker.until(lambda seen: seen.phase == "hold", WITHIN_S, "it holds")
    assert onlooker.phases_of(3.0) == {"hold"}
    assert not witness.authority.holder, "nobody gets it back without a press"
    ann.press("ask")
    commands(witness, "Ann")
    assert onlooker.phases_of(1.0) == {"hold"}
    ann.press("finish")
    onlooker.until(lambda seen: seen.phase == "idle", WITHIN_S, "it is finished")


def test_a_second_operator_who_leaves_lets_the_robot_hold(both, people, witness, onlooker):
    _, bob = both
    takes_over(witness, bob, "Bob", "my turn")
    moving(onlooker, bob)
    bob.leave()
    onlooker.until(lambda seen: seen.phase == "hold", HELD_WITHIN_S, "it holds")
    eventually(lambda: not witness.authority.holder, WITHIN_S, "the lease has run out")
    assert onlooker.phases_of(1.0) == {"hold"}


def test_everybody_is_listed_at_both_pages_and_gone_within_two_seconds(both, people):
    ann, bob = both
    carl = people(1, "Carl", "observer")
    for one in (ann, bob, carl):
        shows(one, "people-watching", "Carl")
        shows(one, "people-commands", "Ann")
        shows(one, "people-second", "Bob")
    carl.leave()
    eventually(lambda: not ann.shown["people-watching"], GONE_WITHIN_S + TOLD_S, "Carl is gone")


@pytest.mark.parametrize("role", ["observer", "supervisor", "operator"])
def test_everybody_may_stop_and_is_named(both, people, witness, onlooker, role):
    ann, _ = both
    zoe = people(1, f"Zoe-{role}", role)
    moving(onlooker, ann)
    zoe.press("stop")
    state = witness.next(topics.SAFETY_STATE, lambda state: state.emergency_stop and state.standing, WITHIN_S)
    assert state.by == f"Zoe-{role}"
    assert witness.robot.phase is Phase.STOPPED
    shows(ann, "stop@data-stop", "stopped")
    ann.press("release_stop")
    witness.next(topics.SAFETY_STATE, lambda state: not state.emergency_stop, WITHIN_S)
