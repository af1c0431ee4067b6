"""A hand at each device of the page leads a robot round where its prediction fails, as it sees it."""

import numpy as np
import pytest

from protocol.messages import Controller, OperatorInput
from protocol.topics import OPERATOR_INPUT
from services.process.master_devices import Page
from tests.services.master.devices.site import POINTS, SAFE, Site, even

TOLERANCE = 0.006  # [m] within which a hand is content
LEAD = 0.03  # a person looks a little ahead: share of the motion
CALM = 0.1  # share of what is left that a dragging hand makes up for in each period


class HandSite(Site):
    """A person at the page of a robot; the device is `kind`."""

    person = Page()
    kind = "keyboard"

    def __init__(self, seed=0):
        self.dragged = np.zeros(3)
        self.before = np.zeros(3)
        super().__init__(seed)

    def publish(self):
        said = OperatorInput(operator="operator", holder="station", epoch=3, present=True, focused=True, **self.hand())
        self.bus.publish(OPERATOR_INPUT, said)
        publish, self.bus.publish = (
            self.bus.publish,
            lambda topic, message: topic is OPERATOR_INPUT or publish(topic, message),
        )
        super().publish()
        self.bus.publish = publish

    def wanted(self):
        """The correction that leads to the safe way, in base axes [m]."""
        ahead = min(1.0, self.progress + LEAD)
        grid = np.linspace(0.0, 1.0, POINTS)
        safe, predicted = (
            np.array([np.interp(ahead, grid, column) for column in way.T]) for way in (even(SAFE)[0], self.prediction)
        )
        return safe - predicted

    def hand(self):
        """What it does now; at first nothing, so that the device is seen at rest."""
        resting = self.ticks < 5
        error = np.zeros(3) if resting else self.wanted() - self.offset
        ways = np.where(np.abs(error) > TOLERANCE, np.sign(error), 0.0)
        match self.kind:
            case "keyboard":
                keys = (("KeyQ", "KeyA"), ("KeyW", "KeyS"), ("KeyE", "KeyD"))
                return {"keys": tuple(pair[int(way < 0)] for pair, way in zip(keys, ways, strict=True) if way)}
            case "gamepad":
                x, y, z = (-1.0 * ways).tolist()
                return {"controllers": (Controller("gamepad", 0, "Pad", True, (y, x, 0.0, z), (0.0,) * 17),)}
            case "spacemouse":
                x, y, z = (-1.0 * ways).tolist()
                return {"controllers": (Controller("spacemouse", axes=(y, x, z, 0.0, 0.0, 0.0), buttons=(0.0, 0.0)),)}
        wanted = np.zeros(3) if resting else self.wanted()
        self.dragged += (wanted - self.before + CALM * error) / self.person.reach
        self.before = wanted
        x, y, z = (-1.0 * self.dragged).tolist()
        return {"controllers": (Controller("pointer", axes=(y, z, x, 0.0, 0.0, 0.0), buttons=(float(not resting),)),)}


@pytest.mark.sim
@pytest.mark.parametrize("kind", ["keyboard", "gamepad", "spacemouse", "pointer"])
def test_a_hand_leads_the_robot_along_the_safe_way(kind):
    class OnDevice(HandSite):
        pass

    OnDevice.kind = kind
    site = OnDevice()
    errors = []
    while site.progress < 1.0:
        state = site.tick()
        errors.append(np.min(np.linalg.norm(even(SAFE)[0] - site.robot, axis=1)))
    assert state.device == kind
    assert state.engaged
    assert max(errors) < 0.035
    assert np.linalg.norm(site.robot - SAFE.positions[-1]) < 0.015
