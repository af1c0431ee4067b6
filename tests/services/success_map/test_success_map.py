"""Maps of success: their conditions, what they come to, and a tiny one simulated."""

import io

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.motion.demonstration import Demonstration
from services.commands.map import Request, draw_map
from services.model.learning import MODELS
from services.offline.first_demonstrations import first_demonstrations
from services.offline.steering import steered
from services.reproduction.models import BY_NAME, DEFAULT
from services.success_map.conditions import (
    Condition,
    Ending,
    Setting,
    SuccessMap,
    Trial,
    grid,
    in_turn,
    sample,
    stage_name,
)
from services.success_map.figure import figure
from services.success_map.work import Tried, conditions
from sim.tasks import DISHWASHER, PARTICLE, TABLE, THESIS
from tests.services.success_map.swift import shown_swiftly, swift

SCENES = {**THESIS, PARTICLE.name: PARTICLE}
SCENE = pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
HOME = tuple(DISHWASHER.training_positions[0].tolist())


@pytest.fixture
def swift_ways(monkeypatch):
    """The scene's own ways, on which it is tried whether a condition can be reached, in less time."""
    monkeypatch.setattr("services.success_map.work.steered", lambda *way: swift(steered(*way)))


def within(places, scene, spread):
    inside = all(scene.region.contains(np.array(place.target)) for place in places)
    return inside and np.max(np.abs([place.offset for place in places])) <= spread


def mapped(*outcomes, corrections=(0, 1)):
    places = [Setting((0.8, 0.01 * i, 0.55), (0.001 * i, 0.0, 0.0)) for i in range(len(outcomes))]
    tried = [Condition(p, tuple(Trial(one) for one in of)) for p, of in zip(places, outcomes, strict=True)]
    return SuccessMap("dishwasher", "b2", "adaptive", corrections, tuple(tried))


@SCENE
@given(n=st.integers(1, 20), spread=st.floats(0.0, 0.2))
def test_a_grid_has_about_its_square_of_places_evenly_all_over_the_region(scene, n, spread):
    places = grid(scene, n, spread)
    assert within(places, scene, spread)
    positions = np.array([place.target for place in places])
    assert len(np.unique(positions, axis=0)) == len(places)
    assert abs(len(places) - n * n) <= n + 2 * n * max(1.0, np.sqrt(8.0)) / 2
    middle = (np.array(scene.region.lower) + scene.region.upper) / 2
    np.testing.assert_allclose(positions.mean(axis=0), middle, atol=1e-9)


def test_starts_of_a_grid_are_on_all_sides():
    offsets = np.array([place.offset for place in grid(TABLE, 8, 0.05)])
    octants = {tuple(side) for side in np.sign(offsets)}
    assert {side for side in octants if 0.0 not in side} == {
        (a, b, c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)
    }


@SCENE
def test_random_places_are_the_same_for_the_same_seed_only(scene):
    one, again, other = (sample(scene, 30, 0.05, np.random.default_rng(seed)) for seed in (3, 3, 4))
    assert one == again != other
    assert within(one, scene, 0.05)
    assert len(one) == 30


def test_a_start_is_moved_from_the_scenes_and_not_turned():
    start = Setting(HOME, (0.01, -0.02, 0.03)).start(DISHWASHER)
    np.testing.assert_allclose(start.position - DISHWASHER.start.position, [0.01, -0.02, 0.03])
    np.testing.assert_array_equal(start.orientation, DISHWASHER.start.orientation)


R, C, U = Ending.REACHED, Ending.COLLISION, Ending.UNREACHABLE


def test_a_summary_counts_among_what_is_reachable():
    found = mapped((C, R), (C, R), (R, R), (Ending.KICKED_OVER, Ending.NOT_REACHED), (U, U))
    assert found.reachable == 4
    assert found.summary() == (
        "after 1 correction: 3 of 4 reachable conditions succeed (75.0 %, 95 % interval 30 to 95 %);"
        " before: 1 (25.0 %, 95 % interval 5 to 70 %)"
    )
    for stage in (0, 1):
        assert sum(found.count(stage, outcome) for outcome in Ending) == len(found.conditions)


def test_what_got_worse_is_said():
    found = mapped((R, C), (R, Ending.KICKED_OVER), (R, R), (C, R))
    assert found.worse == 2
    assert found.summary().endswith("before: 3 (75.0 %, 95 % interval 30 to 95 %), of which 2 fail now")


def test_a_summary_of_one_stage_and_of_nothing():
    found = mapped((R,), (C,), corrections=(0,))
    assert (
        found.summary() == "without correction: 1 of 2 reachable conditions succeed (50.0 %, 95 % interval 9 to 91 %)"
    )
    nothing = mapped((U,), corrections=(2,))
    assert nothing.summary() == "after 2 corrections: 0 of 0 reachable conditions succeed (none was tried)"
    assert stage_name(3, before=True) == "after 3 corrections"


@pytest.mark.sim
@pytest.mark.parametrize("outcomes", [[(C, R), (Ending.KICKED_OVER, Ending.NOT_REACHED), (U, U)], [(R,), (U,)]])
def test_a_picture_shows_what_there_is(outcomes):
    from matplotlib.image import imread

    found = mapped(*outcomes, corrections=tuple(range(len(outcomes[0]))))
    picture = imread(io.BytesIO(figure(DISHWASHER, found, DEFAULT).image))
    height, width, _ = picture.shape
    assert width > height > 600
    green = np.all(np.round(255 * picture[..., :3]) == (0x00, 0x9E, 0x73), axis=-1)
    assert np.any(green), "a condition that succeeded is green"


def test_a_map_is_kept_and_read_again():
    found = mapped((C, R), (U, U))
    assert msgspec.json.decode(msgspec.json.encode(found), type=SuccessMap) == found


def test_models_are_known_by_the_names_of_the_model_process():
    assert MODELS.keys() <= BY_NAME.keys()


@pytest.mark.sim
def test_what_becomes_of_a_condition_is_the_models_doing_where_a_motion_can_succeed(swift_ways):
    model = DEFAULT.fit(shown_swiftly(DISHWASHER))
    far, blocked = Setting((1.3, 0.07, HOME[2])), Setting(HOME, (0.09, 0.04, 0.01))
    trained = conditions(Tried("dishwasher", "b1", ((model,),), (Setting(HOME), far, blocked)), jobs=1)
    assert [one.trials[0].outcome for one in trained] == [R, U, R]
    changed, impossible = conditions(Tried("dishwasher", "b2", ((model, model),), (Setting(HOME), blocked)), jobs=1)
    assert [trial.outcome for trial in impossible.trials] == [U, U]
    assert changed.trials[0] == changed.trials[1]
    assert changed.trials[0].outcome is C
    robot, thing = changed.trials[0].touched
    assert robot.startswith("gripper")
    assert thing.startswith("basket")


@SCENE
def test_corrections_go_through_the_trained_places_first_and_then_as_far_apart_as_can_be(scene):
    targets = in_turn(scene, 6)
    trained = len(scene.training_positions)
    np.testing.assert_allclose(targets[: min(6, trained)], scene.training_positions[:6])
    assert all(scene.region.contains(np.array(target)) for target in targets)
    candidates = np.array([setting.target for setting in grid(scene, 8, 0.0)])
    for n in range(trained, 6):
        nearest = np.linalg.norm(candidates[:, None] - np.array(targets[:n]), axis=2).min(axis=1)
        assert np.linalg.norm(np.subtract(targets[:n], targets[n]), axis=1).min() == pytest.approx(nearest.max())


@pytest.mark.sim
def test_the_figure_of_the_particle_shows_conditions_and_the_order_of_corrections():
    from matplotlib.image import imread

    places = [Setting((0.01 * i, -0.01 * i)) for i in range(5)]
    tried = tuple(Condition(one, (Trial(C), Trial(R))) for one in places)
    order = ((0.0, 0.0), (0.1, 0.1), (-0.1, 0.05))
    plain, marked = (
        imread(
            io.BytesIO(
                figure(
                    PARTICLE, SuccessMap("particle", "obstacle", "adaptive", (0, 3), tried, corrected), DEFAULT
                ).image
            )
        )
        for corrected in ((), order)
    )
    assert marked.shape[1] > 600
    assert plain.shape != marked.shape or np.any(plain != marked)


@pytest.mark.sim
def test_people_take_turns_at_the_conditions_of_the_particle():
    model = DEFAULT.fit(first_demonstrations(PARTICLE))
    taught_too = model.updated(
        Demonstration(
            steered(PARTICLE.corridor("free", np.array([0.1, 0.1])), None, PARTICLE.freedom),
            np.zeros(3),
            np.array([0.1, 0.1]),
        )
    )
    settings = (Setting((0.1, 0.1)), Setting((0.1, 0.1)), Setting((0.0, 0.0)))
    found = conditions(Tried("particle", "free", ((model,), (taught_too,)), settings), jobs=1)
    assert [one.trials[0].outcome for one in found] == [Ending.NOT_REACHED, R, R]


@pytest.mark.sim
def test_the_operator_corrects_once_and_that_is_seen(tmp_path, hurried, swift_ways, monkeypatch):
    monkeypatch.setattr("services.commands.map.first_demonstrations", shown_swiftly)
    found = draw_map(Request(teach=True, grid=1, spread=0.0, jobs=1, out=tmp_path / "map.png"))
    assert found.corrections == (0, 1)
    assert found.count(0, C) == len(found.conditions) == found.count(1, R)
