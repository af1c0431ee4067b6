"""What the model process refuses to learn, in words, without learning anything."""

import numpy as np
import pytest

from protocol import queries
from protocol.messages import Part, Purpose
from protocol.queries import AddDemonstration, Learnt
from services.bus.arrays import motion_to_wire
from tests.services.model.rig import OBJECT, START


def test_a_model_does_not_begin_with_a_part_of_a_motion(rig):
    assert "whole motions" in rig.teach(Purpose.INITIAL, part=Part(0.0, 0.5)).reason
    assert "whole motions" in rig.teach(Purpose.UPDATE, part=Part(0.0, 0.5)).reason
    assert rig.described().version == 0


def test_a_model_of_another_condition_refuses_the_motion(rig):
    rig.teach(Purpose.INITIAL)
    assert "condition" in rig.teach(Purpose.UPDATE, condition=(0.1, 0.2)).reason


def test_a_demonstration_of_another_scene_is_refused_by_both_names(rig):
    reason = rig.teach(Purpose.INITIAL, scene="table").reason
    assert "table" in reason
    assert "dishwasher" in reason
    assert "--scene table" in reason
    assert rig.described().version == 0


def test_the_state_says_what_the_model_is_good_for_before_it_knows_anything(rig):
    assert (rig.described().scene, rig.described().robot_kind) == ("dishwasher", "tiago")


@pytest.mark.parametrize(
    ("beyond", "said"),
    [
        ({"at": (850.0, 50.0, 550.0)}, "the motion passes"),
        ({"bend": -2.0}, "the motion passes"),
        ({"condition": (900.0, 0.0, 0.0)}, "condition"),
        ({"condition": (0.1, 0.2)}, "condition"),
        ({"duration": 1e-300}, "from 0.1 to 3600 s"),
    ],
)
def test_a_motion_that_the_robot_cannot_have_made_is_refused_and_nothing_is_learnt(rig, beyond, said):
    assert said in rig.teach(Purpose.INITIAL, **beyond).reason
    assert rig.described().version == 0


def test_a_motion_that_is_no_number_is_refused_and_nothing_is_learnt(rig):
    motion = motion_to_wire(np.full((5, 3), np.nan), np.tile(START.orientation, (5, 1)), 10.0)
    reply = rig.ask(queries.ADD_DEMONSTRATION, AddDemonstration(Purpose.INITIAL, motion, OBJECT, "dishwasher"))
    assert "finite" in reply.reason
    described = rig.ask(queries.DESCRIBE, queries.Describe())
    assert isinstance(described, Learnt)
    assert described.state.version == 0
