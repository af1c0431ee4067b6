"""A gripper closes on a thing, and holds it."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from services.robot.kinematics import Kinematics
from sim.robots.catalogue import robot
from sim.robots.gripper import pitched_down
from sim.tasks import described, scene
from sim.tasks.reaching import ReachingScene
from sim.world.physics import CONTROL_PERIOD, World

pytestmark = pytest.mark.sim

PLACE = np.array([0.72, 0.10, 0.71])
POINTING = pitched_down(np.radians(30.0))
EACH = pytest.mark.parametrize("name", ["tiago", "panda", "ur5", "xarm7"])


@dataclass
class Hand:
    """A robot that has its gripper around the thing on the table."""

    world: World
    kinematics: Kinematics
    q: np.ndarray
    opening: float
    place: np.ndarray

    @property
    def thing(self) -> np.ndarray:
        """Centre of the thing as the hand sees it [m]."""
        seen = self.world.observe()
        hand = self.kinematics.forward(seen.q)
        turn = Rotation.from_quat(hand.orientation, scalar_first=True)
        return turn.inv().apply(seen.object_position - hand.position)

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds / CONTROL_PERIOD)):
            self.world.step(self.q, np.zeros_like(self.q), self.opening)

    def go(self, offset: tuple[float, float, float], seconds: float) -> None:
        """To a place, from where the thing was first, smoothly."""
        goal = self.kinematics.solve(self.place + offset, POINTING, [self.q], np.random.default_rng(0))
        start, n = self.q, round(seconds / CONTROL_PERIOD)
        shares = np.linspace(0.0, 1.0, n + 1)
        way = start + (shares**3 * (10.0 - 15.0 * shares + 6.0 * shares**2))[:, None] * (goal - start)
        for before, after in pairwise(way):
            self.world.step(after, (after - before) / CONTROL_PERIOD, self.opening)
        self.q = goal


def hand_of(name: str, beside: float = 0.0, where: np.ndarray = PLACE, start: tuple = (0.0, 0.0, 0.01)) -> Hand:
    place = scene("table", robot(name))
    assert isinstance(place, ReachingScene)
    description = described(place)
    world = World(place, "clear", description)
    kinematics = Kinematics(description.urdf, place.posture, place.manipulator)
    around = where + start + np.array([0.0, beside, 0.0])
    q = kinematics.solve(around, POINTING, [place.posture], np.random.default_rng(0))
    world.reset(where, q=q)
    return Hand(world, kinematics, q, place.manipulator.gripper.opening, where)


@EACH
def test_a_thing_is_lifted_and_carried_for_twenty_seconds(name: str) -> None:
    hand = hand_of(name)
    hand.opening = 0.0
    hand.wait(1.5)
    held = hand.thing
    hand.go((0.0, 0.0, 0.20), 2.0)
    hand.go((-0.10, -0.25, 0.15), 3.0)
    hand.wait(12.0)
    hand.go((0.0, 0.0, 0.20), 3.0)
    seen = hand.world.observe()
    assert seen.grasped
    assert seen.opening == pytest.approx(0.05, abs=2e-3)
    assert seen.object_position[2] > PLACE[2] + 0.15
    np.testing.assert_allclose(hand.thing, held, atol=3e-3)


def test_a_jaw_that_turns_lifts_a_thing_though_it_creeps_towards_the_tip() -> None:
    near = np.array([0.64, 0.06, 0.71])
    hand = hand_of("so101", where=near, start=(-0.10, 0.0, 0.05))
    hand.go((0.0, 0.0, 0.01), 2.0)
    hand.opening = 0.0
    hand.wait(1.5)
    held = hand.thing
    hand.go((0.0, 0.0, 0.06), 2.0)
    hand.wait(5.0)
    seen = hand.world.observe()
    assert seen.grasped
    assert seen.object_position[2] > near[2] + 0.04
    np.testing.assert_allclose(hand.thing, held, atol=0.01)


def test_what_is_let_go_falls() -> None:
    hand = hand_of("tiago")
    hand.opening = 0.0
    hand.wait(1.5)
    hand.go((0.0, 0.0, 0.10), 1.0)
    hand.opening = 0.104
    hand.wait(1.5)
    seen = hand.world.observe()
    assert not seen.grasped
    assert seen.opening == pytest.approx(0.104, abs=1e-3)
    assert seen.object_position[2] < PLACE[2] + 0.01


def test_a_thing_that_stands_beside_is_drawn_in_between_the_fingers() -> None:
    hand = hand_of("tiago", beside=0.012)
    assert abs(hand.thing[1]) > 0.01
    hand.opening = 0.0
    hand.wait(3.0)
    hand.go((0.0, 0.0, 0.10), 1.0)
    assert hand.world.observe().grasped
    assert abs(hand.thing[1]) < 0.002


def test_the_opening_changes_at_the_grippers_speed() -> None:
    hand = hand_of("tiago")
    hand.world.reset(PLACE + np.array([0.3, 0.0, 0.0]), q=hand.q)
    hand.opening = 0.0
    hand.wait(0.1)
    openings = []
    for _ in range(50):
        hand.wait(CONTROL_PERIOD)
        openings.append(hand.world.observe().opening)
    np.testing.assert_allclose(np.diff(openings) / CONTROL_PERIOD, -0.1, rtol=0.05)
    hand.wait(1.5)
    assert hand.world.observe().opening == pytest.approx(0.0, abs=1e-4)


def test_fingers_on_the_thing_are_no_collision_and_on_the_table_they_are() -> None:
    hand = hand_of("tiago")
    hand.opening = 0.0
    hand.wait(1.5)
    assert hand.world.observe().grasped
    assert hand.world.observe().contacts == ()
    hand.world.reset(PLACE + np.array([0.3, 0.0, 0.0]), q=hand.q)
    hand.go((0.0, 0.0, -0.07), 1.0)
    assert {contact.robot_geom for contact in hand.world.observe().contacts} <= {
        "gripper_left_finger_link",
        "gripper_right_finger_link",
    }
    assert hand.world.observe().contacts


def test_a_reset_opens_the_gripper() -> None:
    hand = hand_of("panda")
    hand.opening = 0.0
    hand.wait(1.5)
    hand.world.reset(PLACE, q=hand.q)
    assert (hand.world.observe().opening, hand.world.observe().grasped) == (pytest.approx(0.08), False)
