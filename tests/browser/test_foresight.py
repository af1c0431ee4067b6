"""What the view foresees and measures: where the motion goes on, what the gripper would touch, how far a surface is."""

import mujoco
import numpy as np
import pytest

from lfd.motion.rotations import exp_map, multiply, slerp
from sim.robots.gripper import BLOCKS, GRASP_DISTANCE

pytestmark = pytest.mark.browser

FORESIGHT = 'await import("/assets/js/drawing/foresight.js")'
TOUCHING = 'await import("/assets/js/drawing/touching.js")'


@pytest.fixture
def reckoned(viewed):
    """A function that has the page reckon something out of arguments."""
    return lambda module, expression, *given: viewed.page.evaluate(
        f"async (given) => {{ const m = {module}; return {expression}; }}", list(given)
    )


def random_orientations(rng, count):
    q = rng.normal(size=(count, 4))
    return q / np.linalg.norm(q, axis=1, keepdims=True)


@pytest.mark.parametrize(("progress", "fading"), [(0.0, 74.0), (0.33, 74.0), (0.9, 5.0), (1.0, 74.0), (0.5, 0.0)])
def test_what_is_left_of_a_motion_is_the_prediction_and_the_correction_that_fades_by_the_law(
    reckoned, progress, fading
):
    rng = np.random.default_rng(3)
    points = np.cumsum(rng.normal(scale=0.01, size=(75, 3)), axis=0)
    turns = exp_map(np.outer(np.linspace(0.0, 1.0, 75), [0.0, 0.4, 0.1]))
    offset, turn = np.array([0.02, -0.05, 0.1]), np.array([0.3, 0.0, -0.2])
    now = {"progress": progress, "offset": offset.tolist(), "turn": turn.tolist(), "fading": fading}
    curve = {"points": points.tolist(), "orientations": turns.tolist()}
    rest = reckoned(FORESIGHT, "m.released(given[0], given[1])", curve, now)
    shares = np.array(rest["shares"])
    assert (shares[0], shares[-1]) == (pytest.approx(progress), 1.0)
    assert np.all(np.diff(shares) > 0.0)
    kept = np.exp(-fading * (shares - progress)) if fading else (shares == shares[0]).astype(float)
    predicted = np.column_stack([np.interp(shares, np.linspace(0.0, 1.0, 75), points[:, k]) for k in range(3)])
    np.testing.assert_allclose(rest["positions"], predicted + kept[:, None] * offset, atol=1e-12)
    before = np.minimum((shares * 74).astype(int), 73)
    nominal = slerp(turns[before], turns[before + 1], shares * 74 - before)
    turned = multiply(exp_map(kept[:, None] * turn), nominal)
    np.testing.assert_allclose(np.abs(np.sum(turned * rest["orientations"], axis=1)), 1.0, atol=1e-7)


def test_boxes_touch_where_mujoco_finds_no_distance_between_them(reckoned):
    rng = np.random.default_rng(11)
    count = 300
    halves = rng.uniform(0.002, 0.1, size=(count, 2, 3))
    centres = rng.uniform(-0.12, 0.12, size=(count, 2, 3))
    turns = random_orientations(rng, 2 * count).reshape(count, 2, 4)
    spec = mujoco.MjSpec()
    for k in range(2):
        body = spec.worldbody.add_body(name=f"{k}", mocap=True)
        body.add_geom(name=f"{k}", type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.1, 0.1, 0.1])
    model = spec.compile()
    data = mujoco.MjData(model)

    def apart(i):
        model.geom_size[:] = halves[i]
        data.mocap_pos[:], data.mocap_quat[:] = centres[i], turns[i]
        mujoco.mj_kinematics(model, data)
        return mujoco.mj_geomDistance(model, data, 0, 1, 1.0, None)

    distances = np.array([apart(i) for i in range(count)])
    clear = np.abs(distances) > 1e-4
    pairs = [
        [[centres[i, k].tolist(), halves[i, k].tolist(), turns[i, k].tolist()] for k in range(2)] for i in range(count)
    ]
    touching = reckoned(
        TOUCHING, "given[0].map((pair) => m.overlap(...pair.map(([c, h, q]) => m.solidOf('', c, h, q))))", pairs
    )
    assert 30 < np.sum(distances < 0.0) < 270
    np.testing.assert_array_equal(np.array(touching)[clear], (distances < 0.0)[clear])


GRIPPER = [
    {"centre": [block.centre[0] - GRASP_DISTANCE, *block.centre[1:]], "half_sizes": [0.5 * e for e in block.size]}
    for block in BLOCKS
]
WALL = {"name": "wall", "centre": [1.0, 0.0, 0.0], "half_sizes": [0.1, 1, 1], "orientation": [1, 0, 0, 0]}
SIGN = {**WALL, "name": "sign", "centre": [0.5, 0.0, 0.0], "solid": False}


def straight(to, count=75):
    x = np.linspace(0.0, to, count)
    return {
        "points": np.column_stack([x, 0.0 * x, 0.0 * x]).tolist(),
        "orientations": [[1.0, 0.0, 0.0, 0.0]] * count,
    }


def test_the_first_touch_is_where_the_finger_tips_come_to_the_wall_and_names_it(reckoned):
    tips = max(block["centre"][0] + block["half_sizes"][0] for block in GRIPPER)
    rest = straight(1.0)
    expression = "m.foreseen({ ...given[0], positions: given[0].points, shares: given[2] }, given[1], solids(given[3]))"
    touch = reckoned(
        f"{{ ...({FORESIGHT}), ...({TOUCHING}) }}",
        expression.replace("solids", "m.solids"),
        rest,
        GRIPPER,
        np.linspace(0.0, 1.0, 75).tolist(),
        [SIGN, WALL],
    )
    assert touch["name"] == "wall"
    assert touch["share"] == pytest.approx(0.9 - tips, abs=0.01)
    assert touch["position"][0] == pytest.approx(0.9, abs=0.01)


def test_a_way_past_everything_touches_nothing(reckoned):
    touch = reckoned(
        f"{{ ...({FORESIGHT}), ...({TOUCHING}) }}",
        "m.foreseen({ ...given[0], positions: given[0].points, shares: given[2] }, given[1], m.solids(given[3]))",
        straight(0.5),
        GRIPPER,
        np.linspace(0.0, 1.0, 75).tolist(),
        [WALL],
    )
    assert touch is None


@pytest.mark.parametrize(
    ("origin", "direction", "distance", "normal"),
    [
        ([0.0, 0.2, 0.3], [1.0, 0.0, 0.0], 0.9, [-1.0, 0.0, 0.0]),
        ([0.5, 0.0, 0.0], [0.8, 0.6, 0.0], 0.5, [-1.0, 0.0, 0.0]),
        ([1.0, 0.0, 3.0], [0.0, 0.0, -1.0], 2.0, [0.0, 0.0, 1.0]),
    ],
)
def test_how_far_a_surface_is_along_a_line_and_which_way_it_faces(reckoned, origin, direction, distance, normal):
    hit = reckoned(TOUCHING, "m.nearestAlong(given[0], given[1], m.solids(given[2]), 5)", origin, direction, [WALL])
    assert hit["distance"] == pytest.approx(distance)
    np.testing.assert_allclose(hit["normal"], normal, atol=1e-12)


@pytest.mark.parametrize(
    ("origin", "direction", "range_"),
    [
        ([0.0, 0.0, 0.0], [-1.0, 0.0, 0.0], 5.0),
        ([0.0, 1.5, 0.0], [1.0, 0.0, 0.0], 5.0),
        ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], 0.5),
        ([1.0, 0.0, 0.0], [1.0, 0.0, 0.0], 5.0),
    ],
    ids=["behind", "beside", "too far", "inside"],
)
def test_where_there_is_no_surface_there_is_no_distance(reckoned, origin, direction, range_):
    assert (
        reckoned(
            TOUCHING, f"m.nearestAlong(given[0], given[1], m.solids(given[2]), {range_})", origin, direction, [WALL]
        )
        is None
    )


def test_the_dishwasher_s_prediction_is_foreseen_to_touch_its_basket(viewed):
    viewed.wait(".scene[data-view=live]")
    viewed.wait(".mark-foreseen:visible:has-text('basket')")


def test_the_surface_below_the_gripper_is_as_far_as_the_label_says(viewed):
    viewed.wait(".scene[data-view=live]")
    viewed.wait(".mark-below:visible:has-text('32 cm')")
