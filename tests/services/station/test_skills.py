"""The station asks which skills there are when another one is in use or one has changed, and now and then."""

import pytest

from protocol import queries
from protocol.messages import ModelState
from protocol.queries import SkillsListed
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.station.skills import AGAIN_NS, SOON_NS, SkillsReader


class Reading:
    """A reader, and a model that answers in its own step."""

    def __init__(self):
        self.clock = ManualClock()
        network = MemoryNetwork(self.clock)
        self.reader, self.server = SkillsReader(network.bus()), network.bus().serve(queries.SKILLS)
        self.skill, self.version, self.refuses = "cups", 1, False

    def settle(self, seconds=0.01):
        """Let the model answer all that is asked; how many questions there were."""
        asked = 0
        for _ in range(5):
            self.clock.advance(seconds)
            held = {"demonstrations": 1, "updates": 0, "scene": "s", "skill": self.skill}
            self.reader.step(self.clock.now_ns(), ModelState(kind="adaptive", version=self.version, **held))
            for call in self.server.take():
                asked += 1
                call.reply(queries.Refused("not now") if self.refuses else SkillsListed(self.skill, ()))
        return asked


@pytest.fixture
def reading():
    return Reading()


def test_it_is_asked_once_until_another_is_in_use_or_one_has_changed(reading):
    assert reading.settle() == 1
    assert reading.reader.listed == SkillsListed("cups", ())
    assert reading.settle() == 0
    reading.version = 2
    assert reading.settle() == 1
    reading.skill = "plates"
    assert reading.settle() == 1
    assert reading.reader.listed.in_use == "plates"


def test_others_that_were_made_meanwhile_are_found_now_and_then(reading):
    reading.settle()
    reading.clock.advance(AGAIN_NS / 1e9)
    assert reading.settle() == 1


def test_without_an_answer_it_is_asked_again_soon(reading):
    reading.refuses = True
    assert reading.settle() == 1
    assert reading.reader.listed is None
    reading.refuses = False
    reading.clock.advance(SOON_NS / 1e9)
    assert reading.settle() == 1
    assert reading.reader.listed is not None
