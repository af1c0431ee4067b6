"""The lease under every order of what two stations, a supervisor, time and a crash can do, however long it goes on.

A cut is in it: whatever a station was ever granted it may send at any later moment, as a link that is back delivers it.
States that differ in nothing but how they came about are followed once, and there are no more than some hundred.
"""

import copy
from dataclasses import dataclass, field

import pytest

from protocol.messages import AuthorityEvent, AuthorityRequest
from protocol.names import process_name
from protocol.queries import AnswerRequest, ReleaseAuthority, RevokeAuthority
from services.robot import asking
from services.robot.authority import NOBODY, Lease
from services.robot.refusal import Refusal

WAIT_NS = 600_000_000
"""More than half a lease: two of them end it, and what was asked."""

PROCESSES = {"desk": process_name("station", "ann"), "sofa": process_name("station", "bob")}
OTHER = {"desk": "sofa", "sofa": "desk"}


@dataclass
class World:
    """A robot's lease, and what the stations know.

    Attributes:
        granted: every epoch that a station was told to have.
        heard_ns: when the holder was granted the authority, or renewed it.
    """

    lease: Lease = field(default_factory=lambda: Lease(1.0, epoch=100))
    now_ns: int = 0
    heard_ns: int = 0
    granted: dict[str, tuple[int, ...]] = field(default_factory=lambda: {"desk": (), "sofa": ()})

    def key(self):
        """What everything that follows depends on."""
        lease, question = self.lease, self.lease.asking.question
        told = tuple((self.lease.epoch in epochs, len(epochs) > 1) for epochs in self.granted.values())
        asked = None
        if question is not None:
            asked = question.holder, self.now_ns - question.since_ns, self.now_ns - question.said_ns
        declined = tuple(number in lease.asking._declined for number in (1, 2))
        left = lease._expires_ns - self.now_ns if lease.holder != NOBODY else None
        return lease.holder, left, asked, declined, told

    def grant(self, station, epoch):
        self.granted[station] = tuple(sorted({*self.granted[station][-1:], epoch}))
        self.heard_ns = self.now_ns


def acquire(world, station, *, take_over):
    process = PROCESSES[station]
    epoch = world.lease.acquire(
        station, world.now_ns, operator=process, take_over=take_over, reason="it burns", process=process
    )
    world.grant(station, epoch)


def renew(world, station, epoch):
    if world.lease.covers(station, epoch, PROCESSES[station]):
        world.heard_ns = world.now_ns
    world.lease.renew(station, epoch, PROCESSES[station], world.now_ns)


def ask(world, station):
    number = 1 if station == "desk" else 2
    world.lease.ask(AuthorityRequest(holder=station, number=number, process=PROCESSES[station]), world.now_ns)


def answer(world, station, epoch, *, give):
    number = 2 if station == "desk" else 1
    world.lease.answer(AnswerRequest(station, epoch, number, give), world.now_ns)


def wait(world):
    world.now_ns += WAIT_NS
    world.lease.expire(world.now_ns)


def crash(world):
    """The robot's process; its file holds a bound above every epoch that it gave out."""
    world.lease = Lease(1.0, epoch=world.lease.epoch + 1024)


def actions(world):
    """What can happen now: its name, whose act it is, and what does it."""
    yield "wait", "", wait
    yield "crash", "", crash
    yield "revoke", "", lambda w: w.lease.revoke(RevokeAuthority("eve", "unfit"))
    for station in PROCESSES:
        yield "acquire", station, lambda w, s=station: acquire(w, s, take_over=False)
        yield "take over", station, lambda w, s=station: acquire(w, s, take_over=True)
        yield "ask", station, lambda w, s=station: ask(w, s)
        for epoch in world.granted[station]:
            yield "renew", station, lambda w, s=station, e=epoch: renew(w, s, e)
            yield "release", station, lambda w, s=station, e=epoch: w.lease.release(ReleaseAuthority(s, e))
            yield "give", station, lambda w, s=station, e=epoch: answer(w, s, e, give=True)
            yield "keep", station, lambda w, s=station, e=epoch: answer(w, s, e, give=False)


def check(before, name, station, after):
    """What has to hold after every step, however it came to it."""
    old, new = before.lease, after.lease
    assert new.epoch >= old.epoch
    assert new.epoch > old.epoch or new.holder == old.holder, "another holder under the same epoch"
    for one, process in PROCESSES.items():
        for epoch in after.granted[one]:
            mine = new.holder == one and epoch == new.epoch
            assert new.covers(one, epoch, process) == mine, "what counts is of the holder, under its newest epoch"
            assert not new.covers(one, epoch, PROCESSES[OTHER[one]]), "another person's process uses it"
            if epoch != new.epoch:
                with pytest.raises(Refusal):
                    new.check(epoch)
    if new.holder not in (NOBODY, old.holder):
        asked = old.asking.question is not None and old.asking.question.holder == new.holder
        given = asked and (name == "wait" or (name == "give" and station == old.holder))
        taken = name == "take over" and station == new.holder
        free = name == "acquire" and station == new.holder and old.holder == NOBODY
        lapsed = name == "acquire" and station == new.holder and after.now_ns > old._expires_ns
        assert given or taken or free or lapsed, f"{name} of {station} gave the authority to {new.holder}"
    if name == "wait" and new.holder == old.holder != NOBODY:
        assert after.now_ns - after.heard_ns <= new.duration_s * 1e9, "a holder who is not heard keeps it"
    if name == "crash":
        assert new.holder == NOBODY


def step(world, name, act):
    """The world after that; none where it was refused, which must change nothing."""
    after = copy.deepcopy(world)
    try:
        act(after)
    except Refusal:
        after.lease.expire(after.now_ns)
        untouched = copy.deepcopy(world)
        untouched.lease.expire(untouched.now_ns)
        assert after.key() == untouched.key(), f"{name} was refused and changed something"
        return None
    if after.lease.holder != NOBODY and after.lease.epoch not in after.granted[after.lease.holder]:
        after.grant(after.lease.holder, after.lease.epoch)  # it reads that it was given it
    return after


def test_no_order_of_events_lets_two_command_or_one_who_was_not_given_it(monkeypatch):
    monkeypatch.setattr(asking, "SILENCE_GIVES_S", 1.0)  # within the steps that are followed
    start = World()
    seen, edge, events = {start.key()}, [start], set()
    while edge:
        world = edge.pop()
        for name, station, act in actions(world):
            after = step(world, name, act)
            if after is None:
                continue
            check(world, name, station, after)
            events.add(after.lease.event)
            if after.key() not in seen:
                seen.add(after.key())
                edge.append(after)
    assert len(seen) > 100
    assert events == set(AuthorityEvent) - {AuthorityEvent.STOPPED}, "every way to come to it and to lose it was gone"
