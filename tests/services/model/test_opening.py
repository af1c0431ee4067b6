"""The gripper takes part in what is learnt of a task, or it takes none."""

from dataclasses import replace

import numpy as np
import pytest

from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from protocol import queries
from protocol.messages import Purpose
from protocol.queries import AddDemonstration, Learnt, Refused
from services.bus.arrays import motion_to_wire
from services.model.skill import OpeningUnfit, check_demonstration
from services.station.words.heard import heard
from services.station.words.table import speech
from sim.tasks import DISHWASHER
from tests.services.model.rig import OBJECT, START

GRASPING = replace(DISHWASHER, success=replace(DISHWASHER.success, grasped=True))


def motion(opening):
    path = np.linspace(START.position, OBJECT, 40)
    return Trajectory(path, np.tile(START.orientation, (40, 1)), 10.0, opening)


def shown(opening):
    return Demonstration.reaching(motion(opening), np.array(OBJECT))


def test_a_motion_that_says_nothing_of_the_gripper_is_refused_where_that_takes_part():
    check_demonstration(GRASPING, shown(np.full(40, 0.08)))
    with pytest.raises(OpeningUnfit, match="give its opening"):
        check_demonstration(GRASPING, shown(None))


def test_one_that_says_it_is_refused_where_the_gripper_takes_no_part_and_nothing_is_learnt(rig):
    one = motion(np.full(40, 0.08))
    wire = motion_to_wire(one.positions, one.orientations, one.duration, one.opening)
    refused = rig.ask(queries.ADD_DEMONSTRATION, AddDemonstration(Purpose.INITIAL, wire, OBJECT, "dishwasher"))
    assert isinstance(refused, Refused)
    assert "takes no part in dishwasher" in refused.reason
    assert rig.described().demonstrations == 0
    assert isinstance(rig.teach(Purpose.INITIAL), Learnt)


@pytest.mark.parametrize("takes_part", [True, False])
def test_both_are_said_in_the_pages_language(takes_part):
    speech.speak("de")
    try:
        assert "Greifer" in heard(str(OpeningUnfit("pick", takes_part=takes_part)))
    finally:
        speech.speak("en")
