"""Perception survives every sound picture, whatever its values, and publishes nothing that is no pose."""

import logging
import warnings

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from protocol.topics import OBJECT_POSE
from services.bus.memory import MemoryNetwork
from services.perception.service import build
from services.process.clock import ManualClock
from services.process.config import Configuration
from tests import extremes
from tests.cameras import HEAD_IMAGE


@settings(suppress_health_check=list(HealthCheck))
@given(pictures=st.lists(extremes.images, min_size=1, max_size=6))
def test_any_sound_picture_is_used_or_counted(caplog, pictures):
    clock = ManualClock()
    network = MemoryNetwork(clock)
    perception = build(network.bus(), clock, Configuration())
    bus = network.bus()
    found = bus.subscribe(OBJECT_POSE)
    with warnings.catch_warnings(), caplog.at_level(logging.WARNING):
        warnings.simplefilter("error")
        for picture in pictures:
            bus.publish(HEAD_IMAGE, picture)
            perception.step(clock.now_ns())
            clock.advance(0.1)
    perception.figures()
    assert found.drops.malformed == 0
    assert caplog.records == []
