"""What a person has in mind suits the robot: how far they scatter, and what they ask it to turn."""

from dataclasses import replace

import numpy as np
import pytest

from sim.person.plans import Outlook
from sim.person.scatter import USUAL
from sim.robots.catalogue import robot
from sim.tasks import REACHING, THESIS
from sim.tasks.scene import Corridor

PLACE = np.array([0.87, 0.07, 0.553])


def ways(arm: str, count: int = 60) -> np.ndarray:
    scene = replace(THESIS["dishwasher"], manipulator=robot(arm))
    outlook = Outlook(scene, scene.variants[1], PLACE, scene.start)
    rng = np.random.default_rng(0)
    return np.array([outlook.way(None, USUAL, rng).positions for _ in range(count)])


def spread(arm: str) -> float:
    return float(np.sqrt(np.mean(np.var(ways(arm), axis=0))))


@pytest.mark.parametrize("name", THESIS)
def test_people_scatter_with_a_long_arm_as_they_were_measured_to(name: str) -> None:
    assert THESIS[name].unsteadiness == 1.0


@pytest.mark.parametrize("arm", ["panda", "ur5", "xarm7"])
def test_arms_of_nine_tenths_of_a_metre_are_long(arm: str) -> None:
    assert replace(REACHING["pick"], manipulator=robot(arm)).unsteadiness == 1.0


def test_a_small_arm_is_led_as_much_more_carefully_as_it_is_smaller() -> None:
    share = replace(REACHING["pick"], manipulator=robot("so101")).unsteadiness
    assert 0.5 < share < 0.7
    assert spread("so101") == pytest.approx(share * spread("tiago"))


@pytest.mark.parametrize(("arm", "asked"), [("so101", 0.0), ("tiago", 0.4)])
def test_nobody_asks_for_a_turn_of_an_arm_that_may_leave_it_anyway(arm: str, asked: float) -> None:
    scene = replace(THESIS["dishwasher"], manipulator=robot(arm))
    meant: Corridor = scene.corridor(scene.variants[1], PLACE)
    count = len(meant.positions)
    half = 0.5 * 0.4
    turn = np.array([np.cos(half), 0.0, 0.0, np.sin(half)])
    turned = np.array([_product(turn, q) for q in meant.orientations])
    outlook = Outlook(scene, scene.variants[1], PLACE, scene.start)
    intention = outlook.correction(meant.positions, turned, 0.0, np.random.default_rng(0))
    assert len(intention.rotations) == count
    assert np.linalg.norm(intention.rotations[0]) == pytest.approx(asked, abs=1e-9)


def _product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    v = a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
    return np.array([a[0] * b[0] - a[1:] @ b[1:], *v])
