import numpy as np
import pytest

from sim.exceptions import UnknownScene, UnknownVariant, WrongPlace
from sim.pose import Pose
from sim.robots.gripper import pitched_down
from sim.tasks import REACHING, SCENES, THESIS, scene
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import Scene

SCENE = pytest.mark.parametrize("place", SCENES.values(), ids=SCENES)
REACHING_SCENE = pytest.mark.parametrize("place", THESIS.values(), ids=THESIS)


def corners(place: ReachingScene) -> list[np.ndarray]:
    lower, upper = place.region.lower, place.region.upper
    return [np.array([x, y, lower[2]]) for x in (lower[0], upper[0]) for y in (lower[1], upper[1])]


@SCENE
def test_training_positions_lie_in_the_region(place: Scene) -> None:
    assert all(place.region.contains(position) for position in place.training_positions)


@SCENE
def test_samples_lie_in_the_region(place: Scene) -> None:
    rng = np.random.default_rng(0)
    assert all(place.region.contains(place.region.sample(rng)) for _ in range(100))


@SCENE
def test_boxes_have_unique_names_and_unit_quaternions(place: Scene) -> None:
    for variant in place.variants:
        boxes = place.boxes(variant)
        assert len({box.name for box in boxes}) == len(boxes)
        np.testing.assert_allclose([np.linalg.norm(box.quaternion) for box in boxes], 1.0, atol=1e-12)


@REACHING_SCENE
def test_every_corridor_leads_from_the_start_into_the_object(place: ReachingScene) -> None:
    for variant in place.variants:
        for position in corners(place):
            corridor = place.corridor(variant, position)
            np.testing.assert_array_equal(corridor.positions[0], place.start.position)
            np.testing.assert_allclose(corridor.orientations[0], place.start.orientation)
            assert np.all(np.abs(corridor.positions[-1] - position) <= np.array(place.object_size) / 2)


@REACHING_SCENE
def test_a_corridor_from_another_start_joins_the_scenes_own(place: ReachingScene) -> None:
    start = Pose(place.start.position + np.array([-0.05, 0.08, 0.03]), -pitched_down(0.5))
    for variant in place.variants:
        own, other = (place.corridor(variant, place.training_positions[0], s) for s in (place.start, start))
        plain = place.corridor(variant, place.training_positions[0])
        np.testing.assert_array_equal(own.positions, plain.positions)
        np.testing.assert_array_equal(own.orientations, plain.orientations)
        np.testing.assert_array_equal(other.positions[0], start.position)
        half = len(own.positions) // 2
        np.testing.assert_array_equal(other.positions[half:], own.positions[half:])
        np.testing.assert_array_equal(other.orientations[1:], own.orientations[1:])
        np.testing.assert_array_equal(other.orientations[0], -start.orientation)


@REACHING_SCENE
def test_the_correction_between_the_variants_is_within_an_operators_reach(place: ReachingScene) -> None:
    """A refinement that displaces the trained motion by at most 0.20 m gives each way through the changed scene."""
    trained, changed = place.variants
    largest = []
    for position in corners(place):
        before = place.corridor(trained, position)
        for after in place.corridors(changed, position):
            np.testing.assert_array_equal(before.orientations, after.orientations)
            largest.append(np.linalg.norm(after.positions - before.positions, axis=1).max())
    assert 0.10 < max(largest) <= 0.20


def misfit(bends: list[tuple[float, float]]) -> float:
    """By how much the best affine function of the place misses a bend, at most [m]."""
    y, bend = np.array(bends).T
    affine = np.column_stack([np.ones_like(y), y])
    return float(np.max(np.abs(bend - affine @ np.linalg.lstsq(affine, bend, rcond=None)[0])))


def departures(place: ReachingScene, position: np.ndarray) -> list[float]:
    """To the left, of each way round the post from the straight one, where it is furthest [m]."""
    straight = place.corridor("clear", position).positions
    aside = [way.positions[:, 1] - straight[:, 1] for way in place.corridors("post", position)]
    return [float(one[np.argmax(np.abs(one))]) for one in aside]


def test_round_the_post_the_shortest_way_is_first_and_where_it_is_in_the_way_there_are_two() -> None:
    post = scene("post")
    sides = []
    for y in np.linspace(post.region.lower[1], post.region.upper[1], 35):
        found = departures(post, np.array([0.885, y, post.region.lower[2]]))
        assert [abs(one) for one in found] == sorted(abs(one) for one in found)
        sides.append(tuple(np.sign(found)))
    changes = [i for i in range(len(sides) - 1) if sides[i] != sides[i + 1]]
    assert [sides[i] for i in (*changes, -1)] == [(-1.0,), (-1.0, 1.0), (1.0, -1.0)], "each in one stretch"


def test_the_safe_way_round_the_post_is_no_affine_function_of_the_place() -> None:
    """The best affine function misses the bend to one side by a centimetre, and that of the shortest way by many."""
    post = scene("post")
    shortest, right = [], []
    for y in np.linspace(post.region.lower[1], post.region.upper[1], 41):
        found = departures(post, np.array([0.885, y, post.region.lower[2]]))
        shortest.append((y, found[0]))
        right += [(y, one) for one in found if one < 0.0]
    assert misfit(right) > 0.01
    assert misfit(shortest) > 0.05
    assert abs(right[0][1]) < 0.005, "where the straight way passes beside the post it hardly bends"
    for affine_scene in (scene("dishwasher"), scene("table")):
        low, high = np.array(affine_scene.region.lower), np.array(affine_scene.region.upper)
        ways = [affine_scene.corridor(affine_scene.variants[1], p).positions for p in (low, (low + high) / 2, high)]
        np.testing.assert_allclose(ways[1], (ways[0] + ways[2]) / 2, atol=1e-12)


def test_unknown_names_are_refused_with_those_that_are_known() -> None:
    with pytest.raises(UnknownScene, match=r"dishwasher, table, post,.*particle, or the path of a task file"):
        scene("kitchen")
    with pytest.raises(UnknownVariant, match="b1, b2"):
        scene("dishwasher").boxes("b3")


@SCENE
def test_a_place_of_another_dimension_is_refused(place: Scene) -> None:
    with pytest.raises(WrongPlace, match="not 5"):
        place.corridor(place.variants[0], np.zeros(5))


@pytest.mark.parametrize("known", SCENES.values(), ids=SCENES)
def test_a_scene_says_of_its_targets_what_others_need_to_know(known):
    place = known.training_positions[0]
    assert known.has_object == any(known.object_size) == any(known.kick_limits) == (known.targets(place) == ())
    assert min(known.tolerances) > 0.0


def test_an_object_is_missed_along_the_line_to_it_and_a_via_point_beside_it():
    end, target = np.zeros(3), np.array([0.3, 0.0, 0.4])
    assert scene("dishwasher").missed_by(end, target, 1.0) == 0.0
    assert scene("dishwasher").missed_by(end, target, 2.0) == pytest.approx(0.25)
    assert scene("particle").missed_by(end, target, 1.0) == 0.0
    assert scene("particle").missed_by(end, target, 3.0) == pytest.approx(2.0 * scene("particle").tolerance)


def test_a_block_tips_over_the_nearest_edge_of_its_foot():
    """At the angle its centre stands above that edge: the lower half of its height over half of its width."""
    for place in REACHING.values():
        width, depth, height = place.object_size
        half, edge = height / 2, min(width, depth) / 2
        above = half * np.tan(place.tipping_angle)
        assert above == pytest.approx(edge)
        assert np.radians(20.0) < place.tipping_angle < np.radians(35.0)
    assert scene("particle").tipping_angle == 0.0
