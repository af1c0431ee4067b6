"""A robot process with the arm in the dishwasher, an operator, and a clock that is moved by hand."""

import numpy as np

from protocol import messages, queries, topics
from protocol.messages import Mode
from protocol.queries import AuthorityGranted, EpisodeStarted
from services.bus.arrays import motion_to_wire
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.process.config import Configuration
from services.robot.memory import Volatile
from services.robot.service import build
from sim.tasks import scene
from tests.services.predictions import announce

SCENE = scene("dishwasher")
DURATION = 1.48  # [s]: a look-ahead of two control periods


class Site:
    """A robot process, an operator, and a clock that is moved by hand."""

    def __init__(self):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.operator = self.network.bus()
        self.service = build(self.network.bus(), self.clock, Configuration(), Volatile())
        self.robot_state = self.operator.subscribe(topics.ROBOT_STATE)
        self.results = self.operator.subscribe(topics.EPISODE_RESULT)
        self.safety = self.operator.subscribe(topics.SAFETY_STATE)
        self.execution = self.operator.subscribe(topics.EXECUTION)
        self.epoch = 0

    def run(self, seconds, *, renew=True, master=None, rotation=(0.0, 0.0, 0.0), epoch=None):
        for _ in range(round(seconds * 100)):
            self.clock.advance(0.01)
            epoch_now = self.epoch if epoch is None else epoch
            if renew:
                self.operator.publish(
                    topics.AUTHORITY_RENEWAL, messages.AuthorityRenewal(holder="ann", epoch=self.epoch)
                )
            if master is not None:
                state = messages.MasterState(
                    displacement=master, rotation=rotation, engaged=True, holder="ann", epoch=epoch_now
                )
                self.operator.publish(topics.MASTER_STATE, state)
            self.service.step(self.clock.now_ns())

    def ask(self, query, request):
        pending = self.operator.ask(query, request)
        self.run(0.01)
        return pending.poll()

    def acquire(self, holder="ann", *, take_over=False):
        reply = self.ask(queries.ACQUIRE, queries.AcquireAuthority(holder, take_over=take_over))
        assert isinstance(reply, AuthorityGranted)
        self.epoch = reply.epoch

    def execute(self, mode=Mode.AUTONOMOUS, *, request=0, motion=None, adapt=queries.Adapt.NEXT):
        motion = self.lift() if motion is None else motion
        self.predicted, self.identity = motion, announce(self.operator, motion)
        asked = queries.Execute(self.epoch, mode, self.identity, motion.duration, adapt, request=request)
        return self.ask(queries.EXECUTE, asked)

    def refine(self, **asked):
        """Begin a refinement with a hand that rests until the ramp is over."""
        assert isinstance(self.execute(Mode.REFINE, **asked), EpisodeStarted)
        self.run(0.6, master=(0.0, 0.0, 0.0))

    def lift(self, height=0.03, n=75, duration=DURATION):
        """A motion from the start backwards and up, clear of everything."""
        positions = np.tile(SCENE.start.position, (n, 1))
        positions[:, 2] += np.linspace(0.0, height, n)
        return motion_to_wire(positions, np.tile(SCENE.start.orientation, (n, 1)), duration)

    @property
    def state(self):
        return self.robot_state.latest().message

    def take_results(self):
        return [received.message for received in self.results.take()]
