"""A robot process with the arm in the dishwasher, an operator, and a clock that is moved by hand."""

import numpy as np

from protocol import queries, topics
from protocol.messages import Mode
from protocol.queries import EpisodeStarted
from services.bus.arrays import motion_to_wire
from services.process.config import Configuration
from services.robot.memory import Volatile
from services.robot.service import build
from sim.tasks import scene
from tests.services.predictions import announce
from tests.services.robot.operated import Operated

SCENE = scene("dishwasher")
DURATION = 1.48  # [s]: a look-ahead of two control periods


class Site(Operated):
    """See the module."""

    def __init__(self):
        super().__init__(lambda bus, clock: build(bus, clock, Configuration(), Volatile()))
        self.robot_state = self.operator.subscribe(topics.ROBOT_STATE)
        self.results = self.operator.subscribe(topics.EPISODE_RESULT)
        self.safety = self.operator.subscribe(topics.SAFETY_STATE)
        self.execution = self.operator.subscribe(topics.EXECUTION)

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
