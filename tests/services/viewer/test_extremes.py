"""The viewer survives every sound message, whatever its values, and says little about it."""

import logging
import warnings

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from protocol.topics import (
    AUTHORITY_STATE,
    DEPTH,
    MASTER_STATE,
    MODEL_STATE,
    OBJECT_POSE,
    OPERATOR_INPUT,
    POINT_CLOUD,
    PREDICTION,
    ROBOT_STATE,
    SAFETY_STATE,
    SCENE_STATE,
    TEACHING_STATE,
    VERDICT,
    WORLD_STATE,
)
from tests import extremes
from tests.cameras import HEAD_IMAGE

pytestmark = pytest.mark.sim

STRANGE = st.one_of(
    st.tuples(st.just(ROBOT_STATE), extremes.robots),
    st.tuples(st.just(WORLD_STATE), extremes.worlds),
    st.tuples(st.just(SCENE_STATE), extremes.scenes),
    st.tuples(st.just(HEAD_IMAGE), extremes.images),
    st.tuples(st.just(POINT_CLOUD), extremes.clouds),
    st.tuples(st.just(DEPTH), extremes.depths),
    st.tuples(st.just(MASTER_STATE), extremes.masters),
    st.tuples(st.just(OBJECT_POSE), extremes.object_poses),
    st.tuples(st.just(VERDICT), extremes.verdicts),
    st.tuples(st.just(PREDICTION), extremes.predictions),
    st.tuples(st.just(OPERATOR_INPUT), extremes.inputs),
    st.tuples(st.just(AUTHORITY_STATE), extremes.authorities),
    st.tuples(st.just(SAFETY_STATE), extremes.safeties),
    st.tuples(st.just(TEACHING_STATE), extremes.teachings),
    st.tuples(st.just(MODEL_STATE), extremes.models),
)


@settings(max_examples=150, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(messages=st.lists(STRANGE, min_size=1, max_size=8))
def test_any_sound_message_is_drawn_or_counted(system, caplog, messages):
    network, clock, viewer = system
    bus = network.bus()
    caplog.clear()
    with warnings.catch_warnings(), caplog.at_level(logging.WARNING):
        warnings.simplefilter("error")
        for topic, message in messages:
            bus.publish(topic, message)
            viewer.step(clock.now_ns())
            clock.advance(0.1)
    viewer.figures()
    assert caplog.records == []
