"""What a depth picture tells of the things in it: to some millimetres in spite of noise, and nothing where unsure."""

import re
import sys
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest

from services.perception.features import front_edge, organised, rim_height, size
from services.perception.placement import placement
from sim.region import Region

FOCAL, WIDTH, HEIGHT = 300.0, 160, 120
INTRINSICS = (FOCAL, FOCAL, (WIDTH - 1) / 2, (HEIGHT - 1) / 2)
DOWN = placement((0.6, 0.0, 1.0), (0.0, 1.0, 0.0, 0.0))
"""A camera that looks straight down: its picture's right is the base's x, its up the base's y."""

BOX = Region((0.35, -0.15, 0.02), (0.85, 0.15, 0.4))


def table(lower, upper, top):
    """The depth of a block from (x, y) to (x, y), so high, on a table at height zero."""
    depth = np.ones((HEIGHT, WIDTH))
    rows, columns = np.indices(depth.shape)
    away = 1.0 - top
    x = 0.6 + (columns - INTRINSICS[2]) / FOCAL * away
    y = -(rows - INTRINSICS[3]) / FOCAL * away
    inside = (x >= lower[0]) & (x <= upper[0]) & (y >= lower[1]) & (y <= upper[1])
    return np.where(inside, away, depth)


def cloud(depth):
    return organised(depth, INTRINSICS, DOWN)


def test_a_pixels_point_is_where_the_camera_sees_it():
    points = cloud(np.full((HEIGHT, WIDTH), 0.7))
    np.testing.assert_allclose(points[..., 2], 0.3, atol=1e-12)
    np.testing.assert_allclose(points[0, 0], [0.6 - 79.5 / FOCAL * 0.7, 59.5 / FOCAL * 0.7, 0.3])


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("noise", [0.0, 0.003])
def test_a_block_is_measured_to_some_millimetres_with_a_depth_cameras_noise(seed, noise):
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(0.50, 0.60), rng.uniform(-0.06, 0.0)
    along, across, top = rng.uniform(0.06, 0.12), rng.uniform(0.05, 0.09), rng.uniform(0.08, 0.25)
    depth = table((x, y), (x + along, y + across), top) + noise * rng.standard_normal((HEIGHT, WIDTH))
    seen = cloud(depth)
    assert front_edge(seen, BOX) == pytest.approx(x, abs=0.008)
    assert rim_height(seen, BOX) == pytest.approx(top, abs=0.001 if noise == 0.0 else 0.006)
    found = size(seen, Region((0.35, -0.15, 0.0), (0.85, 0.15, 0.4)))
    np.testing.assert_allclose(found, (along, across, top), atol=0.015)


def test_stray_points_move_nothing():
    depth = table((0.55, -0.05), (0.65, 0.05), 0.2)
    strays = depth.copy()
    strays[20:30, 30] = 0.8
    for measured in (front_edge, rim_height):
        assert measured(cloud(strays), BOX) == measured(cloud(depth), BOX)


def test_where_there_is_nothing_or_nothing_is_known_nothing_is_said():
    for depth in (np.ones((HEIGHT, WIDTH)), np.full((HEIGHT, WIDTH), np.inf)):
        assert (front_edge(cloud(depth), BOX), rim_height(cloud(depth), BOX), size(cloud(depth), BOX)) == (None,) * 3


def test_what_goes_on_beyond_the_picture_has_no_edge_in_it():
    cut = table((0.0, -0.05), (0.6, 0.05), 0.2)
    assert front_edge(cloud(cut), Region((0.0, -0.15, 0.02), (0.85, 0.15, 0.4))) is None


BEYOND = 0.50
"""Of the basket's front [m]: five centimetres further out than in the thesis' second arrangement."""

RIM = 0.6025
"""Height of the basket's rail [m]."""


@pytest.fixture(scope="module")
def drawer(tmp_path_factory):
    """A function: the depth picture of the dishwasher whose basket's front is at x, for a vertical field of view."""
    pytest.importorskip("mujoco")
    import sim.tasks
    from sim.robots.robot import Camera
    from sim.tasks import described, scene
    from sim.world.cameras import Cameras
    from sim.world.physics import World

    written = (Path(sim.tasks.__file__).parent / "dishwasher.toml").read_text()
    file = tmp_path_factory.mktemp("task") / "dishwasher.toml"

    def draw(x, fovy):
        file.write_text(re.sub(r"b1 = \[0\.73,", f"b1 = [{x:.4f},", written))
        place = scene(str(file))
        description = described(place)
        mount = next(one.mount for one in place.manipulator.cameras if one.name == "head")
        state = World(place, "b1", description).state
        with closing(Cameras(place, description, more=(Camera("head", mount, fovy),))) as cameras:
            cameras.show("b1")
            cameras.render("head", state)
            depth, at = cameras.depth(), cameras.pose("head", state)
            (fx, _, cx), (_, fy, cy), _ = cameras.intrinsics("head").tolist()
        return depth, (fx, fy, cx, cy), placement(at.position, at.orientation)

    return draw


@pytest.mark.sim
def test_the_baskets_front_and_rim_are_measured_wherever_it_is_drawn_out_to(drawer, capsys):
    """Within 4 mm with a depth camera's noise of 3 mm; by the field of view of a real depth camera, 46 degrees."""
    box, rng = Region((0.40, -0.10, 0.56), (0.80, 0.25, 0.66)), np.random.default_rng(7)
    errors = []
    for x in np.linspace(0.73, BEYOND, 10):
        depth, intrinsics, camera = drawer(x, 46.0)
        noisy = np.round(1000.0 * (depth + 0.003 * rng.standard_normal(depth.shape))) / 1000.0
        seen = organised(noisy, intrinsics, camera)
        errors.append((front_edge(seen, box) - x, rim_height(seen, box) - RIM))
    front, rim = 1e3 * np.abs(errors).max(axis=0)
    with capsys.disabled():
        sys.stdout.write(f"\nbasket's front within {front:.1f} mm, its rim within {rim:.1f} mm, at ten places\n")
    assert max(front, rim) < 4.0


@pytest.mark.sim
def test_a_front_that_the_head_camera_does_not_see_any_more_is_not_made_up(drawer):
    box = Region((0.40, -0.10, 0.56), (0.80, 0.25, 0.66))
    assert front_edge(organised(*drawer(BEYOND, 36.0)), box) is None
