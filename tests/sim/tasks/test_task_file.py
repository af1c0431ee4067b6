"""A task is a file: those that ship are what they were, a person's own is found by its path, a fault is one line."""

import hashlib
from pathlib import Path

import numpy as np
import pytest

import sim.tasks
from sim.exceptions import TaskUnfit
from sim.region import Region
from sim.robots.catalogue import robot
from sim.robots.meshes import ball, write_stl
from sim.robots.robot import Base
from sim.tasks import REACHING, scene
from sim.tasks.reaching import ReachingScene

SMALL = """
name = "mine"
variants = ["before", "after"]
training_places = [[0.6, 0.1, 0.55]]

boxes = [
    { name = "table", centre = [0.7, 0.0, 0.25], size = [0.6, 1.0, 0.5] },
    { name = "brick", centre = [0.5, 0.0, 0.55], size = [0.1, 0.1, 0.1], variants = ["after"] },
]

[start]
position = [0.4, 0.0, 0.7]
pitch = 40.0

[[objects]]
name = "cup"
size = [0.05, 0.05, 0.10]
tag = { id = 3, dictionary = "DICT_APRILTAG_36h11", size = 0.05 }
region = { lower = [0.55, -0.2, 0.55], upper = [0.7, 0.2, 0.55] }
"""


def written(folder: Path, text: str = SMALL) -> str:
    path = folder / "task.toml"
    path.write_text(text)
    return str(path)


def task(folder: Path, text: str = SMALL) -> ReachingScene:
    found = scene(written(folder, text))
    assert isinstance(found, ReachingScene)
    return found


def digest(place: ReachingScene) -> str:
    """Of all numbers of a scene's boxes and ways, to a picometre."""
    lower, upper = np.array(place.region.lower), np.array(place.region.upper)
    told: list[object] = []
    for variant in place.variants:
        for box in sorted(place.boxes(variant), key=lambda one: one.name):
            told += [box.name, np.round([*box.centre, *box.half_sizes, *box.quaternion, *box.rgba], 12).tolist()]
        for share in np.linspace(-0.1, 1.1, 13):
            for way in place.corridors(variant, lower + share * (upper - lower)):
                told += [np.round(way.positions, 12).tolist(), np.round(way.orientations, 12).tolist()]
    return hashlib.sha256(repr(told).replace("-0.0,", "0.0,").encode()).hexdigest()[:16]


@pytest.mark.parametrize(
    ("name", "known"),
    [("dishwasher", "e0b8e1daf87f05d9"), ("table", "dbcdaa91afce06b6"), ("post", "8c30cd257270ffcb")],
)
def test_the_thesis_scenes_are_what_they_were_before_they_were_files(name: str, known: str) -> None:
    assert digest(REACHING[name]) == known


def test_a_task_is_one_file() -> None:
    folder = Path(sim.tasks.__file__).parent
    files = {path.stem for path in folder.glob("*.toml")}
    assert files == set(REACHING) >= {"dishwasher", "table", "post"}
    for name in files:
        assert REACHING[name].name == name


def test_a_persons_own_is_found_by_its_path_and_goes_by_its_name(tmp_path: Path) -> None:
    found = task(tmp_path)
    assert (found.name, found.variants, found.target.name) == ("mine", ("before", "after"), "cup")
    assert [box.name for box in found.boxes("before")] == ["table"]
    assert [box.name for box in found.boxes("after")] == ["table", "brick"]
    assert found.boxes("before")[0].half_sizes == (0.3, 0.5, 0.25)
    again = scene(found.reference, robot("panda"))
    assert (again.name, again.robot.kind) == ("mine", "panda")


def test_without_ways_it_has_no_corridor_to_show_and_says_so(tmp_path: Path) -> None:
    assert not task(tmp_path).is_drawn
    assert REACHING["table"].is_drawn


def test_robots_stand_where_the_task_says(tmp_path: Path) -> None:
    text = SMALL + "[base.panda]\nposition = [0.1, 0.2, 0.3]\nyaw = 90.0\n[base.default]\nposition = [0.0, 0.0, 0.1]\n"
    path = written(tmp_path, text)
    bases = {kind: scene(path, robot(kind)).stance.base for kind in ("panda", "ur5")}
    assert bases == {"panda": Base((0.1, 0.2, 0.3), np.pi / 2), "ur5": Base((0.0, 0.0, 0.1))}


def test_a_mesh_lies_beside_the_file_and_is_shown_as_the_box_around_it(tmp_path: Path) -> None:
    write_stl(tmp_path / "ball.stl", ball())
    text = SMALL + '[[meshes]]\nname = "bowl"\nfile = "ball.stl"\nposition = [0.8, 0.1, 0.6]\nscale = 0.05\n'
    found = task(tmp_path, text)
    shown = found.shown("before")[-1]
    assert shown.name == "bowl"
    np.testing.assert_allclose([*shown.centre, *shown.half_sizes], [0.8, 0.1, 0.6, 0.05, 0.05, 0.05], atol=2e-3)


def test_what_is_placed_on_a_box_stands_on_it(tmp_path: Path) -> None:
    found = task(tmp_path, SMALL + '[success]\nlifted = 0.05\nplaced_on = "table"\n')
    assert found.gripper
    assert found.success.placed is not None
    np.testing.assert_allclose(found.success.placed.lower, [0.4, -0.5, 0.54])
    assert not task(tmp_path).gripper


def test_the_one_that_is_named_is_the_one_that_motions_are_relative_to(tmp_path: Path) -> None:
    other = '[[objects]]\nname = "jar"\nsize = [0.1, 0.1, 0.1]\nshape = "cylinder"\ntag = { id = 4 }\n'
    other += "region = { lower = [0.5, 0.3, 0.55], upper = [0.7, 0.3, 0.55] }\n"
    text = SMALL.replace('name = "mine"', 'name = "mine"\ntarget = "jar"').replace("0.6, 0.1, 0.55", "0.6, 0.3, 0.55")
    found = task(tmp_path, text + other)
    assert [thing.name for thing in found.things] == ["jar", "cup"]
    assert found.region == Region((0.5, 0.3, 0.55), (0.7, 0.3, 0.55))
    assert found.target.round


TWO = '\n[[objects]]\nname = "jar"\nsize = [0.1, 0.1, 0.1]\ntag = { id = 3, dictionary = "DICT_APRILTAG_36h11" }\n'
TWO += "region = { lower = [0.5, 0.3, 0.5], upper = [0.7, 0.3, 0.5] }\n"
MESH = '\n[[meshes]]\nname = "m"\nfile = "m.stl"\nposition = [0, 0, 0]\n'


@pytest.mark.parametrize(
    ("before", "after", "line"),
    [
        ("pitch = 40.0", "pich = 40.0", r"start: unknown key pich; did you mean pitch\?"),
        ("[start]", "[strat]", r"unknown key strat; did you mean start\?"),
        ("position = [0.4, 0.0, 0.7]", "", "start: the key is missing: position"),
        ("[0.4, 0.0, 0.7]", "[0.4, 0.0]", "start.position: expected 3 values, got 2"),
        ("[0.4, 0.0, 0.7]", '[0.4, 0.0, "x"]', "start.position, number 3: expected a number, got a text"),
        ("pitch = 40.0", "pitch = true", "start.pitch: expected a number, got true or false"),
        ("size = [0.6, 1.0, 0.5]", "size = [0.6, 1.0, 0.0]", "table: size: each edge has to be above 0"),
        ("36h11", "36h12", r"cup: unknown tag dictionary .*36h12; did you mean DICT_APRILTAG_36h1"),
        ("id = 3", "id = 587", "objects cup: unknown tag 587: DICT_APRILTAG_36h11 has 0 to 586"),
        ('tag = { id = 3, dictionary = "DICT_APRILTAG_36h11", size = 0.05 }', "", "cup: .*it has no tag to be seen by"),
        ("0.6, 0.1, 0.55", "0.9, 0.1, 0.55", r"training_places, number 1: .* outside the region of cup"),
        ('variants = ["after"]', 'variants = ["afer"]', r"brick: there is no variant afer; did you mean after\?"),
        ("size = [0.6, 1.0, 0.5] }", 'size = [0.6, 1.0, 0.5], variants = ["after"] }', "variant before has no boxes"),
        ("size = [0.1, 0.1, 0.1],", 'size = [0.1, 0.1, 0.1], colour = "red",', "there is no colour red; one of none"),
        ('name = "mine"', 'name = "My Task"', "'My Task' is no name"),
        ('name = "mine"', 'name = "mine"\ntarget = "cap"', r"there is no object cap; did you mean cup\?"),
        ('name = "mine"', "name = ", "it is no TOML"),
        ("\n[start]", TWO + "\n[start]", "objects jar and cup have the same tag, 3 of DICT_APRILTAG_36h11"),
        ("\n[start]", MESH + "\n[start]", "mesh m.stl is missing"),
        ("\n[start]", '\n[success]\nmay_touch = ["tabel"]\n[start]', r"no box or mesh tabel; did you mean table\?"),
    ],
)
def test_a_fault_is_one_line_with_its_place_and_what_would_be_right(
    tmp_path: Path, before: str, after: str, line: str
) -> None:
    assert before in SMALL
    with pytest.raises(TaskUnfit, match=line) as caught:
        task(tmp_path, SMALL.replace(before, after, 1))
    assert "\n" not in str(caught.value)
    assert "task.toml" in str(caught.value)


def test_the_example_of_a_small_arm_stands_where_that_reaches_it() -> None:
    desk = scene(str(Path(__file__).parents[3] / "deploy/examples/desk.toml"), robot("so101"))
    assert isinstance(desk, ReachingScene)
    low, high = np.array(desk.robot.reach.lower), np.array(desk.robot.reach.upper)
    for place in (desk.start.position, np.array(desk.region.lower), np.array(desk.region.upper)):
        assert np.all((low < place) & (place < high))


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(TaskUnfit, match=r"gone\.toml: No such file"):
        scene(str(tmp_path / "gone.toml"))


def test_what_is_kept_for_a_task_is_told_apart_by_all_that_its_file_says(tmp_path: Path) -> None:
    """What was taught in one arrangement is no good in another of the same name."""
    first = task(tmp_path).told
    assert task(tmp_path).told == first
    for before, after in (("0.5, 0.0, 0.55", "0.5, 0.1, 0.55"), ("pitch = 40.0", "pitch = 41.0"), ("0.10]", "0.11]")):
        assert before in SMALL
        assert task(tmp_path, SMALL.replace(before, after)).told != first
    write_stl(tmp_path / "ball.stl", ball())
    text = SMALL + '[[meshes]]\nname = "bowl"\nfile = "ball.stl"\nposition = [0.8, 0.1, 0.6]\n'
    whole = task(tmp_path, text).told
    write_stl(tmp_path / "ball.stl", ball()[:-4])
    assert task(tmp_path, text).told != whole
