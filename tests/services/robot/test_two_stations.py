"""A robot between two stations, whatever they, their links and its process do: it obeys one, and stands without it."""

import tempfile
from pathlib import Path

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from protocol import messages, queries, topics
from protocol.messages import Mode, Phase
from protocol.queries import AuthorityGranted, EpisodeStarted
from services.robot.memory import SafetyFile
from tests.services.predictions import announce
from tests.services.robot.site import AtOnce, Site, straight

STATIONS = st.sampled_from(["ann", "bob"])
PERIOD_S = 0.01
HOLD_S = 0.2
"""After this long without its operator a robot stands: `RobotSection.presence_after_s`."""


class Teleoperation(RuleBasedStateMachine):
    """Two operators; what they send waits while their link is cut, and comes all at once when it is back."""

    def __init__(self):
        super().__init__()
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name) / "safety.json"
        self.epochs = {"ann": 0, "bob": 0}
        self.granted = set()
        self.cut = {"ann": False, "bob": False}
        self.waiting = {"ann": [], "bob": []}
        self.present = {"ann": False, "bob": False}
        self.heard_ago_s = {"ann": np.inf, "bob": np.inf}
        self.latched = False
        self.started = ""

    @initialize()
    def begin(self):
        self.site = Site(SafetyFile(self.path, AtOnce()))
        self.step()

    def teardown(self):
        self.folder.cleanup()

    def send(self, station, deliver):
        if self.cut[station]:
            self.waiting[station].append(deliver)
        else:
            deliver()

    def step(self):
        """One control period; whoever is there says so."""
        self.site.clock.advance(PERIOD_S)
        for station in self.epochs:
            self.heard_ago_s[station] += PERIOD_S
            if self.present[station]:
                self.send(station, lambda s=station, e=self.epochs[station]: self.renew(s, e))
        before = None if self.site.states.latest() is None else self.site.state
        self.site.service.step(self.site.clock.now_ns())
        self.check(before)

    def renew(self, station, epoch):
        lease = self.site.control.lease
        if (lease.holder, lease.epoch) == (station, epoch):
            self.heard_ago_s[station] = 0.0
        self.site.operator.publish(topics.AUTHORITY_RENEWAL, messages.AuthorityRenewal(holder=station, epoch=epoch))

    def ask(self, query, request):
        pending = self.site.operator.ask(query, request)
        self.step()
        return pending.poll()

    @rule(station=STATIONS, over=st.booleans())
    def acquire(self, station, over):
        if self.cut[station]:
            return
        asked = queries.AcquireAuthority(station, take_over=over, reason="it burns" if over else "")
        reply = self.ask(queries.ACQUIRE, asked)
        if isinstance(reply, AuthorityGranted):
            assert reply.epoch > max(self.granted, default=0), "an epoch comes twice"
            assert not self.latched, "a robot that is stopped gives out no authority"
            self.epochs[station] = reply.epoch
            self.granted.add(reply.epoch)
            self.present[station] = True

    @rule(station=STATIONS, over=st.booleans(), periods=st.integers(1, 120))
    def execute(self, station, over, periods):
        """As a station does: get the authority first, where it has none."""
        if self.cut[station]:
            return
        if self.site.control.lease.holder != station:
            self.acquire(station, over)
        motion = straight(duration=2.0)
        prediction = announce(self.site.operator, motion)
        epoch = self.epochs[station]
        may = self.site.control.lease.holder == station and epoch == self.site.control.lease.epoch
        reply = self.ask(queries.EXECUTE, queries.Execute(epoch, Mode.AUTONOMOUS, prediction, motion.duration))
        if isinstance(reply, EpisodeStarted):
            assert may, "a motion began for somebody who may not command"
            assert not self.latched, "a motion began though the robot is stopped"
            self.started = station
        self.wait(periods)

    @rule(station=STATIONS, there=st.booleans())
    def come_or_go(self, station, there):
        self.present[station] = there

    @rule(station=STATIONS)
    def lose_the_link(self, station):
        self.cut[station] = True

    @rule(station=STATIONS)
    def have_it_back(self, station):
        self.cut[station] = False
        waiting, self.waiting[station] = self.waiting[station], []
        for deliver in waiting:
            deliver()
        self.step()

    @rule(periods=st.integers(1, 60))
    def wait(self, periods):
        for _ in range(periods):
            self.step()

    @precondition(lambda self: self.started)
    @rule()
    def press_the_stop(self):
        self.latched = True
        self.site.press()

    @precondition(lambda self: self.latched)
    @rule()
    def release_the_stop(self):
        self.ask(queries.RELEASE_STOP, queries.ReleaseStop("ann"))
        self.latched = False

    @precondition(lambda self: self.started)
    @rule()
    def crash(self):
        """The robot's process is killed and started again; the arm stays where it is."""
        highest = self.site.control.lease.epoch
        self.site.service.close()
        self.site = Site(SafetyFile(self.path, AtOnce()))
        assert self.site.control.lease.epoch > highest, "an epoch from before the crash would count"
        self.started = ""
        self.waiting = {"ann": [], "bob": []}
        self.step()

    def check(self, before):
        """What holds in every control period."""
        lease, state = self.site.control.lease, self.site.state
        if before is None or state.publisher != before.publisher:
            return
        moved = np.linalg.norm(np.subtract(state.reference.position, before.reference.position)) > 1e-9
        if moved:
            assert not self.latched, "it moves though it is stopped"
            assert lease.holder == self.started, "it moves for somebody who did not ask for it"
            assert self.heard_ago_s[lease.holder] <= HOLD_S + PERIOD_S, "it moves though its operator is not heard"

    @invariant()
    def the_stop_stays_what_it_is(self):
        if hasattr(self, "site"):
            assert self.site.control.latch.latched == self.latched
            assert (self.site.state.phase is Phase.STOPPED) == self.latched


Teleoperation.TestCase.settings = settings(max_examples=25, stateful_step_count=40, deadline=None)
test_whatever_happens_it_obeys_one_and_stands_without = Teleoperation.TestCase
