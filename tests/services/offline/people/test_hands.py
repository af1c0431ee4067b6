"""A simulated person's hand at each device leads a robot where it should go, through the devices' own code.

The robot is a point that follows at once where it is led, and a moment later where it is corrected.
"""

from dataclasses import dataclass

import numpy as np
import pytest

from protocol.messages import Mode, Phase, Pose, RobotState
from services.bus.arrays import quaternion, vector3
from services.master.devices.controllers import Controllers
from services.master.devices.device import Moment
from services.master.devices.keys import Keys
from services.master.devices.led import LedMaster
from services.master.devices.pointer import Pad
from services.master.devices.profiles import Profiles
from services.offline.people.hands import hand_at
from services.offline.people.ways import Device
from services.process.master_devices import Page
from sim import pose as sim_pose
from sim.person.attention import Attention
from sim.person.helm import Helm
from sim.person.itinerary import Itinerary
from sim.person.plans import Outlook
from sim.person.scatter import CAREFUL, USUAL
from sim.person.sight import USUAL as MISJUDGED
from sim.person.sight import Sight
from sim.rotations import rotated, rotation_to
from sim.tasks import DISHWASHER
from tests.sim.person.test_hand import predicted

PERIOD = 0.02
LOOK_AHEAD = 20.0 / 74
LEADING = (Device.KEYBOARD, Device.GAMEPAD, Device.SPACE_MOUSE, Device.POINTER)
PLACE = np.array([0.86, 0.20, 0.553])


def seed_of(device):
    return LEADING.index(device)


@dataclass
class Point:
    """A robot that is led, and whoever leads it by a device."""

    device: Device
    mode: Mode
    seed: int

    def __post_init__(self):
        profiles = Profiles()
        sources = (Keys(), *(Controllers(kind, profiles) for kind in ("gamepad", "spacemouse")), Pad(profiles))
        self.master = LedMaster(Page(), sources)
        self.hand = hand_at(self.device, np.random.default_rng((self.seed, 4)))
        sight = Sight(np.array(DISHWASHER.eye.position), MISJUDGED, np.random.default_rng((self.seed, 2)))
        self.helm = Helm(Attention(sight))
        self.rng = np.random.default_rng((self.seed, 3))
        self.outlook = Outlook(DISHWASHER, DISHWASHER.variants[-1], PLACE, DISHWASHER.start)
        self.robot = DISHWASHER.start
        self.offset = self.turn = np.zeros(3)
        self.led = None
        self.ticks = 0
        self.progress = 0.0

    @property
    def time(self):
        return self.ticks * PERIOD

    def sample(self):
        """One look at the device."""
        state = RobotState(
            measured=wire(self.robot),
            reference=wire(self.robot),
            phase=Phase.EXECUTE,
            mode=self.mode,
            offset=vector3(self.offset),
            turn=vector3(self.turn),
        )
        self.ticks += 1
        now_ns = round(self.time * 1e9)
        return self.master.step(Moment(now_ns, PERIOD, self.hand.says(self.time), state, commands=True))

    def follow_correction(self, correction):
        """Towards what is asked for, as the look-ahead has it; the prediction goes on."""
        sample = self.sample()
        share = PERIOD / LOOK_AHEAD
        self.offset = self.offset + share * (np.array(sample.displacement) - self.offset)
        self.turn = self.turn + share * (np.array(sample.rotation) - self.turn)
        self.progress = min(1.0, self.progress + PERIOD / 20.0)
        predicted = correction.predicted(self.progress)
        self.robot = sim_pose.Pose(predicted.position + self.offset, rotated(predicted.orientation, self.turn))

    def follow_hand(self):
        """By what the hand did, while it is at the device."""
        sample = self.sample()
        now = (np.array(sample.displacement), np.array(sample.rotation)) if sample.engaged else None
        if now is not None and self.led is not None:
            turned = now[1] - self.led[1]
            self.robot = sim_pose.Pose(
                self.robot.position + now[0] - self.led[0], rotated(self.robot.orientation, turned)
            )
        self.led = now


def wire(pose):
    return Pose(vector3(pose.position), quaternion(pose.orientation))


@pytest.mark.parametrize("device", LEADING, ids=lambda device: device.value)
def test_a_correction_follows_what_is_meant_within_what_a_hand_can(device):
    apart = []
    for seed in range(2):
        point = Point(device, Mode.REFINE, 10 * seed_of(device) + seed)
        positions, orientations = predicted(DISHWASHER.corridor(DISHWASHER.variants[0], PLACE))
        correction = point.outlook.correction(positions, orientations, USUAL, point.rng)
        point.robot = correction.predicted(0.0)
        while point.progress < 1.0:
            if point.time > 0.3:
                point.hand.correct(point.helm, point.time, point.progress, point.robot, correction)
            point.follow_correction(correction)
            apart.append(np.linalg.norm(point.robot.position - correction.pose(point.progress).position))
        assert apart[-1] < 0.035
    assert np.percentile(apart, 90) < 0.045


@pytest.mark.parametrize("stops", [True, False], ids=["waypoints", "demonstration"])
@pytest.mark.parametrize("device", LEADING, ids=lambda device: device.value)
def test_a_hand_that_leads_alone_comes_to_every_place_in_a_persons_time(device, stops):
    point = Point(device, Mode.TEACH, seed_of(device))
    way = point.outlook.way(None, CAREFUL, point.rng)
    itinerary, arrived = Itinerary(way, stops=stops), []
    while not itinerary.over:
        if point.time > 0.3 and point.hand.lead(point.helm, point.time, point.robot, itinerary):
            arrived.append(point.robot)
            point.hand.rest()
        point.follow_hand()
        assert point.time < 120.0, "nobody has that much patience"
    ends = way.positions[1:] if stops else way.positions[-1:]
    assert len(arrived) == len(ends)
    for robot, place in zip(arrived, ends, strict=True):
        assert np.linalg.norm(robot.position - place) < 0.05
    assert np.linalg.norm(rotation_to(arrived[-1].orientation, way.orientations[-1])) < 0.3
