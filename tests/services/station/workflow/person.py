"""A person who teaches by a method, stepped by hand."""

import msgspec
import numpy as np

from protocol.messages import Cut, ModelState
from services.bus.arrays import motion_to_wire
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import (
    BY_HAND,
    MISSED,
    POSE,
    Site,
)

EMPTY = ModelState(kind="adaptive", version=0, demonstrations=0, updates=0, scene="dishwasher")
MOVING = {"cmd/reset", "cmd/execute", "cmd/teleoperate", "cmd/resume"}
FINISHED = {"completed": False, "reason": "finished by ann", "cut": Cut.FINISHED}


def shown_way(n=300, lingering=200):
    """A way that was led by hand, with a long pause in its middle."""
    t = np.concatenate([np.linspace(0.0, 0.5, n // 2), np.full(lingering, 0.5), np.linspace(0.5, 1.0, n // 2)])[:, None]
    positions = np.array([0.5, 0.0, 0.5]) + t * [0.3, 0.0, 0.1]
    return motion_to_wire(positions, np.tile([1.0, 0.0, 0.0, 0.0], (len(t), 1)), 40.0)


class Teaching(Site):
    """A person who teaches by a method."""

    def __init__(self, method, *, empty=False):
        super().__init__(BY_HAND)
        if empty:
            self.sees(model=EMPTY)
        self.run_to(Phase.DECIDING)
        self.choose(method)

    def choose(self, method):
        self.step(Action.METHOD, argument=method.value)
        self.decide()

    def decide(self):
        """Until the operator is asked, and told what s/he may do."""
        self.run_to(Phase.DECIDING)
        self.step()

    def lead(self):
        self.press(Action.LEAD, Phase.EXECUTING)

    def at(self, x):
        self.robot(measured=msgspec.structs.replace(POSE, position=(x, 0.0, 0.5)))

    def store(self, *places):
        for x in places:
            self.at(x)
            self.step(Action.STORE)

    def finish(self, outcome=MISSED, **changes):
        self.step(Action.FINISH)
        self.step()
        self.end(outcome, operator_input=True, **{**FINISHED, **changes})
        self.step()
        self.decide()

    def executed(self, outcome, **changes):
        """The robot comes to the end of what it executes."""
        self.step()
        self.end(outcome, **changes)
        self.step()

    @property
    def told(self):
        return teaching_state(self.state, self.view, self.settings)

    @property
    def places(self):
        return [waypoint.position[0] for waypoint in self.told.waypoints]
