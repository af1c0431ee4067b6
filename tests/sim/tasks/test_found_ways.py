"""A task that nobody drew a way for gets one: straight on where that is clear, else a bow, else one that is sampled."""

from pathlib import Path

import numpy as np
import pytest

from sim.exceptions import NoWay
from sim.planning import sampling
from sim.planning.arm import PlanningArm
from sim.planning.ways import CLEARANCE, is_clear, places, ways
from sim.robots.catalogue import robot
from sim.tasks import scene
from sim.tasks.reaching import ReachingScene

pytestmark = pytest.mark.sim

TASK = """
name = "mine"
variants = ["open", "wall"]
training_places = [[0.68, 0.08, 0.56], [0.68, 0.20, 0.56]]
boxes = [
    { name = "table", centre = [0.78, 0.0, 0.48], size = [0.7, 1.2, 0.04] },
    { name = "wall", centre = [0.66, -0.08, 0.56], size = [0.30, 0.03, 0.12], variants = ["wall"] },
]
[start]
position = [0.56, -0.26, 0.63]
pitch = 45.0
[[objects]]
name = "jar"
size = [0.05, 0.05, 0.12]
tag = { id = 7 }
region = { lower = [0.66, 0.06, 0.56], upper = [0.72, 0.22, 0.56] }
"""


def task(folder: Path, arm: str, text: str = TASK) -> ReachingScene:
    path = folder / "mine.toml"
    path.write_text(text)
    found = scene(str(path), robot(arm))
    assert isinstance(found, ReachingScene)
    return found


@pytest.mark.parametrize("arm", ["tiago", "panda", "xarm7"])
def test_the_way_is_straight_where_nothing_is_in_it_and_clear_of_what_is(tmp_path: Path, arm: str) -> None:
    place = task(tmp_path, arm)
    planned = PlanningArm(place)
    before, after = (place.corridor(variant, place.training_positions[0]) for variant in place.variants)
    straight = np.cross(before.positions[:5] - before.positions[0], before.positions[4] - before.positions[0])
    np.testing.assert_allclose(straight, 0.0, atol=1e-9)
    np.testing.assert_allclose(before.orientations, after.orientations)
    assert 0.03 < np.linalg.norm(after.positions - before.positions, axis=1).max() < 0.20
    found = ways(place)
    for where in places(place):
        assert is_clear(planned, "wall", found["wall"], where, CLEARANCE)
        assert not is_clear(planned, "wall", found["open"], where, 0.0)


def test_the_same_way_is_found_again(tmp_path: Path) -> None:
    found = [ways(task(tmp_path, "panda"), tmp_path / one) for one in ("first", "second")]
    assert found[0] == found[1]


def test_a_way_leads_into_the_object_wherever_it_is(tmp_path: Path) -> None:
    place = task(tmp_path, "panda")
    for where in places(place):
        corridor = place.corridor("open", where)
        np.testing.assert_array_equal(corridor.positions[0], place.start.position)
        assert np.all(np.abs(corridor.positions[-1] - where) <= np.array(place.object_size) / 2)


def test_a_path_is_sampled_between_two_poses_and_touches_nothing(tmp_path: Path) -> None:
    place = task(tmp_path, "panda")
    arm = PlanningArm(place)
    arm.arrange("wall", place.training_positions[0])
    end = place.corridor("wall", place.training_positions[0])
    q = arm.solve(place.start, arm.seeds())
    assert q is not None
    goal = arm.pose(q)
    goal.position[:] = end.positions[-3]
    path = sampling.path(arm, place.start, goal, 0.005, 0.0)
    assert path is not None
    np.testing.assert_allclose(arm.pose(path[-1]).position, goal.position, atol=2e-3)
    assert not any(arm.touches(one, 0.0, 0.0) for one in path)


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ("position = [0.56, -0.26, 0.63]", "position = [2.0, -0.26, 0.63]", "it does not reach the start"),
        ("lower = [0.66, 0.06, 0.56], upper = [0.72", "lower = [0.66, 0.06, 0.56], upper = [1.90", "the whole region"),
    ],
)
def test_where_there_is_none_it_is_said_why(tmp_path: Path, before: str, after: str, reason: str) -> None:
    place = task(tmp_path, "panda", TASK.replace(before, after))
    with pytest.raises(NoWay, match=reason):
        place.corridor("open", place.training_positions[0])
