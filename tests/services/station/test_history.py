"""The station asks the model for its history when it is another one, and for what a tab wants to see of it."""

import pytest

from protocol import queries
from protocol.messages import ModelState
from protocol.queries import Compared, Effect, HistoryListed
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.station.history import AGAIN_NS, HistoryReader
from services.station.page.effects import Effects

EFFECT = Effect((0.85, 0.05, 0.55), None, None, None)


class Reading:
    """A reader, and a model that answers in its own step."""

    def __init__(self, *, there=True):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.effects = Effects()
        self.reader = HistoryReader(self.network.bus(), self.effects)
        self.version, self.skill = 4, "cups"
        if there:
            self.start()

    def start(self):
        bus = self.network.bus()
        self.history, self.compare = bus.serve(queries.HISTORY), bus.serve(queries.COMPARE)

    def step(self, seconds=0.01):
        self.clock.advance(seconds)
        held = {"demonstrations": 1, "updates": 0, "scene": "s", "skill": self.skill}
        state = ModelState(kind="adaptive", version=self.version, **held)
        self.reader.step(self.clock.now_ns(), state)

    def settle(self, reply=EFFECT):
        """Let the model answer all that is asked; how many questions there were."""
        asked = 0
        for _ in range(12):
            self.step()
            for call in self.history.take():
                asked += 1
                call.reply(HistoryListed(self.version, (), 0))
            for call in self.compare.take():
                asked += 1
                call.reply(reply if isinstance(reply, queries.Refused) else Compared(self.version, reply))
        return asked


@pytest.fixture
def reading():
    return Reading()


def test_the_history_is_asked_for_once_a_version(reading):
    assert reading.settle() == 1
    assert reading.reader.rows.version == 4
    assert reading.settle() == 0
    reading.version = 6
    assert reading.settle() == 1
    assert reading.reader.rows.version == 6


def test_what_a_tab_wants_to_see_is_asked_for_until_it_is_there(reading):
    reading.settle()
    reading.effects._wanted[3] = None
    assert reading.settle(None) == 1
    assert reading.effects.wanted() == 3
    reading.clock.advance(AGAIN_NS / 1e9)
    assert reading.settle() == 1
    assert reading.effects.wanted() is None


def test_what_the_model_refuses_is_asked_for_no_more(reading):
    reading.settle()
    reading.effects._wanted[3] = None
    assert reading.settle(queries.Refused("no such entry")) == 1
    assert reading.effects.wanted() is None
    assert b"no such entry" in reading.effects._known[3]


def test_where_the_model_does_not_answer_it_is_asked_again_but_not_at_once():
    reading = Reading(there=False)
    reading.step()
    reading.step()
    reading.start()
    assert reading.settle() == 0
    reading.clock.advance(AGAIN_NS / 1e9)
    assert reading.settle() == 1
    assert reading.reader.rows.version == 4


def test_without_a_model_nothing_is_asked(reading):
    reading.reader.step(reading.clock.now_ns(), None)
    assert reading.history.take() == []


def test_another_skill_of_the_same_version_has_another_history(reading):
    reading.settle()
    edition = reading.reader.rows.edition
    reading.skill = "plates"
    assert reading.settle() == 1
    assert reading.reader.rows.edition != edition
