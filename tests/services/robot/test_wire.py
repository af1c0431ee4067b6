"""The robot's own values as messages."""

from dataclasses import replace

import numpy as np

from services.robot.wire import scene_state
from sim.tasks import DISHWASHER, PARTICLE
from sim.tasks.scene import Group


def test_what_is_only_drawn_cannot_be_touched():
    told = scene_state(DISHWASHER, DISHWASHER.variants[1], DISHWASHER.start, np.zeros(0))
    known = {box.name: box.group is not Group.DETAIL for box in DISHWASHER.boxes(DISHWASHER.variants[1])}
    assert {box.name: box.solid for box in told.boxes} == known
    assert set(known.values()) == {True, False}


def test_a_ring_to_pass_through_is_no_thing():
    condition = PARTICLE.training_positions[0]
    told = scene_state(PARTICLE, PARTICLE.variants[1], PARTICLE.start, condition)
    rings = {box.name for box in PARTICLE.targets(condition)}
    assert rings
    assert {box.name for box in told.boxes if not box.solid} >= rings


def test_how_wide_the_gripper_opens_is_said_where_it_takes_part():
    told = scene_state(DISHWASHER, DISHWASHER.variants[1], DISHWASHER.start, np.zeros(0))
    assert told.wide_open == DISHWASHER.wide_open == 0.0
    grasping = replace(DISHWASHER, success=replace(DISHWASHER.success, grasped=True))
    told = scene_state(grasping, DISHWASHER.variants[1], DISHWASHER.start, np.zeros(0))
    assert told.wide_open == DISHWASHER.manipulator.gripper.opening > 0.0


def test_where_first_motions_are_shown_is_told():
    told = scene_state(DISHWASHER, DISHWASHER.variants[1], DISHWASHER.start, np.zeros(0))
    np.testing.assert_array_equal(told.training_places, DISHWASHER.training_positions)
