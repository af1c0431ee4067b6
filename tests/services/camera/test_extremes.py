"""The camera survives every sound message, whatever its values, and publishes nothing that is none itself."""

import logging
import warnings

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from protocol.topics import SCENE_STATE, WORLD_STATE
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.process.config import CameraSection, Configuration
from tests import extremes
from tests.cameras import HEAD_IMAGE, WRIST_IMAGE

pytestmark = pytest.mark.sim

STRANGE = st.one_of(
    st.tuples(st.just(WORLD_STATE), extremes.worlds),
    st.tuples(st.just(SCENE_STATE), extremes.scenes),
)


@pytest.fixture
def system():
    from services.camera.service import build

    clock = ManualClock()
    network = MemoryNetwork(clock)
    service = build(network.bus(), clock, Configuration(camera=CameraSection(width=64, height=48)))
    yield network, clock, service
    service.close()


@settings(max_examples=40, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(messages=st.lists(STRANGE, min_size=2, max_size=6))
def test_any_sound_message_is_drawn_or_counted(system, caplog, messages):
    network, clock, camera = system
    bus = network.bus()
    heads, wrists = bus.subscribe(HEAD_IMAGE), bus.subscribe(WRIST_IMAGE)
    caplog.clear()
    with warnings.catch_warnings(), caplog.at_level(logging.WARNING):
        warnings.simplefilter("error")
        for topic, message in messages:
            bus.publish(topic, message)
            camera.step(clock.now_ns())
            clock.advance(0.1)
    camera.figures()
    assert heads.drops.malformed == wrists.drops.malformed == 0
    # A scene that is not known here is said once, not with every state; one may stand there from before.
    assert len(caplog.records) <= 1 + sum(topic is SCENE_STATE for topic, _ in messages)
