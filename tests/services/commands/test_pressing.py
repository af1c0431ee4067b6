"""A stop from afar is pressed until the robot's own state shows it; a release is one request, however often asked."""

import pytest

from protocol import queries, topics
from protocol.messages import AuthorityState, SafetyState
from services.bus.bus import Failed
from services.bus.memory import MemoryNetwork
from services.commands.pressing import LOOK_NS, Press, PressAll, Release, Revoke, story
from services.process.clock import ManualClock
from services.process.exceptions import CommandFailed

PRESSED = SafetyState(
    emergency_stop=True, standing=True, by="bob", at="2026-11-26T10:00:00Z", reason="it hit the table"
)


class World:
    """A robot that says what a test lets it say, and an operator's bus."""

    def __init__(self):
        self.clock = ManualClock()
        network = MemoryNetwork(self.clock)
        self.bus = network.bus("cli-1")
        self._robot = network.bus("robot")
        self.presses = self._robot.subscribe(topics.EMERGENCY_STOP)
        self.releases = self._robot.serve(queries.RELEASE_STOP)
        self.revocations = self._robot.serve(queries.REVOKE)

    def commands(self, operator):
        self._robot.publish(
            topics.AUTHORITY_STATE, AuthorityState(operator=operator, holder="s", epoch=7, expires_in=1.0)
        )

    def says(self, **state):
        self._robot.publish(topics.SAFETY_STATE, SafetyState(**state))

    def step(self, one):
        self.clock.advance(0.1)
        return one.step(self.clock.now_ns())


@pytest.fixture
def world():
    return World()


def test_it_presses_until_the_stop_is_latched_and_the_arm_stands(world):
    press = Press(world.bus, "anna")
    assert world.step(press) == "it is not heard"
    world.says(emergency_stop=False, standing=True)
    assert world.step(press) == "it has not latched"
    world.says(emergency_stop=True, standing=False)
    assert world.step(press) == "it has latched, but it still moves"
    assert [(r.message.pressed, r.message.by) for r in world.presses.take()] == [(True, "anna")] * 3
    world.says(emergency_stop=True, standing=True)
    assert world.step(press) == ""
    assert world.presses.take() == []


def test_a_state_of_before_the_outage_confirms_nothing(world):
    press = Press(world.bus, "anna")
    world.says(emergency_stop=True, standing=True)
    world.clock.advance(10.0)
    assert world.step(press) == "it is not heard"
    assert len(world.presses.take()) == 1


class Two(World):
    """Another robot beside it, the garage's."""

    def __init__(self):
        super().__init__()
        network, other = MemoryNetwork(self.clock), MemoryNetwork(self.clock, "garage")
        network.join(other)
        self.bus = network.bus("cli-1")
        self._robot, self._other = network.bus("robot"), other.bus("robot")
        self.press = PressAll(self.bus, network.robot, "anna")

    def of_the_garage(self, **state):
        self._other.publish(topics.SAFETY_STATE, SafetyState(**state))


def test_all_robots_are_pressed_and_whoever_did_not_stop_is_named():
    two = Two()
    two.step(two.press)
    two.clock.advance(LOOK_NS / 1e9)
    two.says(emergency_stop=True, standing=True)
    two.of_the_garage(emergency_stop=True, standing=False)
    assert two.step(two.press) == "garage: it has latched, but it still moves"
    assert two.press.stopped == {"robot1"}
    two.says(emergency_stop=True, standing=True)
    two.of_the_garage(emergency_stop=True, standing=True)
    assert two.step(two.press) == ""
    assert two.press.stopped == {"garage", "robot1"}


def test_of_all_robots_one_that_is_not_there_is_not_waited_for():
    two = Two()
    two.step(two.press)
    two.clock.advance(LOOK_NS / 1e9)
    two.of_the_garage(emergency_stop=True, standing=True)
    assert two.step(two.press) == ""
    assert two.press.stopped == {"garage"}


def test_all_robots_is_nobody_where_none_is_heard(world):
    press = PressAll(world.bus, "robot1", "anna")
    world.step(press)
    world.clock.advance(LOOK_NS / 1e9)
    assert world.step(press) == "no robot is heard"


def test_others_may_be_there_until_everybody_has_been_heard(world):
    press = PressAll(world.bus, "robot1", "anna")
    world.says(emergency_stop=True, standing=True)
    assert world.step(press) == "others may be there"


def test_a_release_whose_answer_was_lost_is_the_same_request_again(world):
    release = Release(world.bus, "anna")
    assert world.step(release) == "it is not heard"
    world.says(**fields(PRESSED))
    assert world.step(release) == "it has not answered"
    (first,) = world.releases.take()
    release._request._pending.settle(Failed("lost"))
    assert world.step(release) == "lost"
    world.step(release)
    assert world.releases.take() == [], "known again by its number, and joined"
    assert first.request.by == "anna"
    assert first.request.request > 0
    first.reply(queries.Accepted())
    assert world.step(release) == ""
    assert release.was.by == "bob"


def test_two_releases_are_two_requests(world):
    for release in (Release(world.bus, "anna"), Release(world.bus, "anna")):
        world.says(**fields(PRESSED))
        world.step(release)
    first, second = world.releases.take()
    assert first.request.request != second.request.request


def test_a_refused_release_says_why(world):
    release = Release(world.bus, "anna")
    world.says(**fields(PRESSED))
    world.step(release)
    (call,) = world.releases.take()
    call.reply(queries.Refused("the button at the robot is pressed"))
    with pytest.raises(CommandFailed, match="the button at the robot is pressed"):
        world.step(release)


def test_who_releases_reads_who_had_pressed_when_and_why():
    assert story(PRESSED) == "bob had pressed it at 2026-11-26T10:00:00Z (it hit the table)"
    assert story(SafetyState(emergency_stop=False)) == "no stop was latched"


def fields(state):
    return {name: getattr(state, name) for name in ("emergency_stop", "standing", "by", "at", "reason", "released_by")}


def test_a_revocation_is_one_request_that_says_who_and_why_and_whose_authority_it_was(world):
    revoke = Revoke(world.bus, "eve", "it is late")
    assert world.step(revoke) == "it is not heard"
    world.commands("ann")
    assert world.step(revoke) == "it has not answered"
    world.commands("bob")
    assert world.step(revoke) == "it has not answered"
    (call,) = world.revocations.take()
    assert (call.request.by, call.request.reason) == ("eve", "it is late")
    call.reply(queries.Accepted())
    assert world.step(revoke) == ""
    assert revoke.was.operator == "ann"


def test_a_revocation_that_the_robot_refuses_is_said(world):
    revoke = Revoke(world.bus, "eve", "it is late")
    world.commands("")
    world.step(revoke)
    (call,) = world.revocations.take()
    call.reply(queries.Refused("nobody holds the authority"))
    with pytest.raises(CommandFailed, match="the authority was not revoked: nobody holds the authority"):
        world.step(revoke)
