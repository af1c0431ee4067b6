"""A person's whole session: a skill that fails is taught once at the page, by a device, and then succeeds by itself."""

import numpy as np
import pytest

from protocol.messages import OperatorInput
from services.master.devices.controllers import hand
from services.master.devices.keys import Keys
from services.offline.first_demonstrations import first_demonstrations
from services.offline.people import told
from services.offline.people.session import Session, taught
from services.offline.people.ways import Device, Teaching
from services.offline.result import Arrangement
from services.process import default_profiles
from sim.tasks import DISHWASHER, PARTICLE


def test_what_the_page_says_of_a_push_is_read_back_as_the_push():
    pushed = np.array([1.0, -1.0, 0.0, 1.0, 0.0, -1.0])
    keys = Keys().look(OperatorInput(keys=told.keys(pushed)))["keyboard"]
    assert (*keys.push, *keys.turn) == tuple(pushed)
    for tell, profile in (
        (told.gamepad, default_profiles.STANDARD_GAMEPAD),
        (told.space_mouse, default_profiles.SPACE_MOUSE),
    ):
        read = hand(tell(pushed, profile, (profile.buttons.store,)), profile)
        np.testing.assert_allclose((*read.push, *read.turn), pushed)
        assert read.actions == ("store",)


@pytest.mark.sim
@pytest.mark.parametrize(
    ("teaching", "device"),
    [(Teaching.PREDICTION, Device.KEYBOARD), (Teaching.REFINEMENT, Device.GAMEPAD)],
    ids=["keyboard", "gamepad"],
)
def test_the_particles_motion_is_corrected_at_the_page(teaching, device):
    demonstrations = tuple(first_demonstrations(PARTICLE))
    arrangement = Arrangement("free", condition=(0.1, 0.1))
    done = taught(Session("particle", demonstrations, arrangement, teaching, device, seed=0))
    assert done.learnt
    assert done.adapted
    assert done.why == ()


@pytest.mark.sim
def test_the_dishwashers_skill_is_taught_by_waypoints_that_a_gamepads_button_stores():
    demonstrations = tuple(first_demonstrations(DISHWASHER))
    arrangement = Arrangement("b2", (0.86, 0.07, DISHWASHER.region.lower[2]))
    done = taught(Session("dishwasher", demonstrations, arrangement, Teaching.WAYPOINTS, Device.GAMEPAD, 0))
    assert done.learnt
    assert done.adapted
