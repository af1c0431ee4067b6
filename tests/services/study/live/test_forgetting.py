"""In a training every update is taken back, once, and nothing else."""

from protocol import queries
from protocol.messages import ModelState
from protocol.queries import Learnt
from protocol.topics import MODEL_STATE
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.study.live.forgetting import Forgetting


class Model:
    """Stands in for the model's process: it has updates, and takes them back."""

    def __init__(self):
        self.network = MemoryNetwork(ManualClock())
        bus = self.network.bus("model")
        self.bus, self.served = bus, bus.serve(queries.UNDO)
        self.version, self.updates = 2, 0
        self.asked = []

    def says(self):
        state = self.state()
        self.bus.publish(MODEL_STATE, state)

    def state(self):
        return ModelState(
            kind="adaptive", version=self.version, demonstrations=2, updates=self.updates, scene="particle"
        )

    def learns(self):
        self.version, self.updates = self.version + 1, self.updates + 1
        self.says()

    def answers(self):
        for call in self.served.take():
            self.asked.append(call.request)
            self.version, self.updates = self.version + 1, self.updates - 1
            call.reply(Learnt(self.state()))


def test_what_was_learnt_is_taken_back_once_however_late_the_model_says_so():
    model = Model()
    forgetting = Forgetting(model.network.bus("study"), "study")
    model.says()
    forgetting.step()
    model.answers()
    assert model.asked == []
    model.learns()
    for _ in range(5):
        forgetting.step()
        model.answers()
    assert len(model.asked) == 1
    assert model.asked[0].operator == "study"
    model.says()
    forgetting.step()
    model.learns()
    for _ in range(5):
        forgetting.step()
        model.answers()
    assert (len(model.asked), model.updates) == (2, 0)
