"""A person, or a script, before an empty skill."""

import msgspec

from protocol import queries
from protocol.messages import Method
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from tests.services.station.workflow.person import EMPTY, Teaching, shown_way
from tests.services.station.workflow.site import BY_HAND, REACHED, Site

TRAINING = ((0.67, 0.04, 0.71), (0.67, 0.22, 0.71), (0.83, 0.04, 0.71), (0.83, 0.22, 0.71))
FIRST, SECOND = TRAINING[0], TRAINING[3]
METHODS = (Method.WAYPOINTS, Method.DEMONSTRATE)


class Guided(Teaching):
    """A person before an empty skill; what is executed without a verdict of its own succeeds."""

    def __init__(self, method=Method.WAYPOINTS, model=EMPTY, training=TRAINING, settings=BY_HAND):
        Site.__init__(self, settings)
        self.sees(model=model, scene=msgspec.structs.replace(self.view.scene, training_places=training))
        self.run_to(Phase.DECIDING)
        self.choose(method)

    @property
    def at_step(self):
        return self.told.showing.step if self.told.showing is not None else None

    def put(self):
        self.press(Action.PUT, Phase.RESETTING)
        self.decide()

    def show(self, outcome=REACHED):
        self.put()
        self.lead()
        if self.state.approach.method is Method.WAYPOINTS:
            self.store(0.5, 0.6, 0.7)
        self.finish(outcome, commanded=shown_way())

    def replay(self, outcome=REACHED):
        self.press(Action.EXECUTE, Phase.EXECUTING)
        self.executed(outcome)
        self.decide()

    def keep(self):
        self.press(Action.TEACH, Phase.LEARNING)
        self.decide()

    def teach(self):
        self.show()
        self.replay()
        self.keep()

    def placed(self):
        return [request.object_position for request in self.requests(queries.RESET)]


def holding(demonstrations, updates=0, version=9):
    return msgspec.structs.replace(EMPTY, demonstrations=demonstrations, updates=updates, version=version)
