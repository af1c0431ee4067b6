"""Nothing that anybody sends ends a process: any bytes, and sound messages and requests with any content."""

import random

import msgspec
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from protocol import queries, topics
from protocol.codec import decode_reply
from protocol.messages import Mode
from services.bus.memory import MemoryNetwork
from services.master.service import build as build_master
from services.model.service import build as build_model
from services.perception.service import build as build_perception
from services.process.clock import ManualClock
from services.process.config import Configuration, MasterSection, ModelSection
from services.process.master_devices import Scripted
from services.station.service import StationService
from tests.cameras import TOPICS
from tests.services.extremes import Extremes, encoded
from tests.services.predictions import announce
from tests.services.robot.site import Site, straight
from tests.services.station.site import BY_HAND

MESSAGES = 12

# What fails comes again by its seed; a smaller seed is no simpler one.
by_seed = settings(max_examples=6, phases=(Phase.explicit, Phase.generate))
SEEDS = st.integers(0, 2**32)


class Attacked:
    """A service that is stepped while strangers send what they like to it."""

    def __init__(self, network, clock, service, known=None):
        self.network, self.clock, self.service, self.known = network, clock, service, known or {}
        self.refused = 0

    def attack(self, seed):
        rng = random.Random(seed)
        extremes = Extremes(rng, self.known)
        heard = [s.topic for s in self.network.subscriptions]
        for i in range(MESSAGES):
            topic = rng.choice(heard)
            self.network.deliver(topic, self._sound(extremes, topic, seed, i))
            self.network.deliver(topic, rng.randbytes(rng.randrange(200)))
            if self.network.servers:
                self._ask(rng, extremes)
            self.step()

    def _sound(self, extremes, topic, seed, number):
        source = topic.publisher if topic.publisher != "any" else "robot"
        place = {"robot": self.network.robot, "topic": topic.name, "process": source}
        sent = {"publisher": seed + 1, "sequence": number + 1, "stamp_ns": self.clock.now_ns()}
        return encoded(msgspec.structs.replace(extremes.struct(topic.type), **place, **sent))

    def _ask(self, rng, extremes):
        query = rng.choice([query for query in queries.QUERIES if query.name in self.network.servers])
        server, answers = self.network.servers[query.name], []
        for payload in (encoded(extremes.struct(query.request)), rng.randbytes(rng.randrange(200))):
            server.receive(payload, "", answers.append)
        self.step()
        self.refused += sum(isinstance(decode_reply(query, answer), queries.Refused) for answer in answers)
        assert len(answers) == 2, "every request is answered"

    def step(self):
        for _ in range(3):
            self.clock.advance(1.0 / self.service.rate_hz)
            self.service.step(self.clock.now_ns())


@by_seed
@given(seed=SEEDS)
def test_nothing_ends_the_robot_s_process(seed):
    site = Site()
    site.acquire()
    site.execute(Mode.REFINE)
    identity = announce(site.operator, straight())
    known = {
        "epoch": (site.epoch,),
        "holder": ("ann", "bob"),
        "prediction": (identity,),
        "duration": (0.5, 1.0, 120.0),
        "object_position": (None,),
        "variant": (None, "obstacle"),
        "start": (None,),
    }
    attacked = Attacked(site.network, site.clock, site.service, known)
    attacked.attack(seed)
    assert attacked.refused
    before = site.state.sequence
    site.run(0.05)
    assert site.state.sequence == before + 5, "and says in each of its periods what it does"


@by_seed
@given(seed=SEEDS)
def test_nothing_ends_the_station_s_process(seed):
    clock = ManualClock()
    network = MemoryNetwork(clock)
    Attacked(network, clock, StationService(network.bus(), BY_HAND, None, seed=3)).attack(seed)


@pytest.mark.parametrize("device", [MasterSection(), MasterSection(device=Scripted())], ids=["keyboard", "scripted"])
@by_seed
@given(seed=SEEDS)
def test_nothing_ends_the_master_s_process(device, seed):
    clock = ManualClock()
    network = MemoryNetwork(clock)
    master = build_master(network.bus(), clock, Configuration(master=device))
    Attacked(network, clock, master, {"name": ("table", "dishwasher", "particle"), "episode": (1,)}).attack(seed)


@by_seed
@given(seed=SEEDS)
def test_nothing_ends_the_model_s_process(tmp_path_factory, seed):
    clock = ManualClock()
    network = MemoryNetwork(clock)
    section = ModelSection(database=str(tmp_path_factory.mktemp("model") / "model.sqlite"))
    model = build_model(network.bus(), clock, Configuration(model=section))
    known = {"scene": ("dishwasher",), "object_position": ((0.85, 0.05, 0.55),), "condition": ((),)}
    attacked = Attacked(network, clock, model, known)
    attacked.attack(seed)
    assert attacked.refused
    model.close()


@by_seed
@given(seed=SEEDS)
def test_nothing_ends_the_perception_s_process(seed):
    clock = ManualClock()
    network = MemoryNetwork(clock)
    Attacked(network, clock, build_perception(network.bus(), clock, Configuration())).attack(seed)


def test_every_topic_is_heard_by_somebody_who_is_tried():
    """But for those that only the viewer and the camera hear, which draw: tests/system sends them what they cannot."""
    clock = ManualClock()
    network = MemoryNetwork(clock)
    StationService(network.bus(), BY_HAND, None, seed=3)
    build_master(network.bus(), clock, Configuration(master=MasterSection(device=Scripted())))
    heard = {s.topic.name for s in (*network.subscriptions, *Site().network.subscriptions)}
    drawing = (topics.WORLD_STATE, topics.TEACHING_STATE, topics.HEARTBEAT, topics.PICTURE_QUEUE, topics.DEPTH)
    drawn = {topic.name for topic in drawing}
    asked = {topics.PROBE.name, topics.LOAD.name}  # which only who sends them hears
    assert heard >= {topic.name for topic in TOPICS} - drawn - asked
