"""A robot of a person's own: what its file says, and what is wrong with it, a line each."""

from pathlib import Path

import pytest

from services.process.config import RobotSection
from services.process.exceptions import ConfigurationError
from services.process.robot_file import load_robot
from services.process.robots import manipulator, scene_of
from sim.exceptions import FileMissing, RobotUnfit
from sim.robots import faults
from sim.robots.robot import Base

INERTIA = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
LINK = '<link name="{}">' + INERTIA + "{}</link>"
JOINT = (
    '<joint name="{}" type="revolute"><parent link="{}"/><child link="{}"/><origin xyz="0 0 0.3"/><axis xyz="0 1 0"/>'
    "{}</joint>"
)
LIMIT = '<limit lower="-2" upper="2" velocity="1" effort="10"/>'
MESH = '<visual><geometry><mesh filename="package://own/{}"/></geometry></visual>'

FILE = """
name = "own"
description = "own.urdf"
home = [0.1, -0.2]

[[joints]]
name = "first"

[[joints]]
name = "second"
speed = 0.5
acceleration = 3.0

[gripper]
link = "tip"
two_fingers = true

[base]
position = [0.1, 0.0, 0.2]

[stances.table]
base = {{ position = [0.3, 0.0, 0.5] }}
{}
"""


def fingers(joint: str, *, wide: float = 0.04, jaw: str = "arm") -> str:
    """A file whose gripper is the description's own."""
    own = f"fingers = [{{{{{joint}, closed = 0.0, wide = {wide}}}}}]\njaw = '{jaw}'"
    return FILE.replace("two_fingers = true", own)


def urdf(*, limit: str = LIMIT, mesh: str = "") -> str:
    links = LINK.format("foot", mesh) + LINK.format("arm", "") + LINK.format("tip", "")
    joints = JOINT.format("first", "foot", "arm", LIMIT)
    return f"<robot name='x'>{links}{joints}{JOINT.format('second', 'arm', 'tip', limit)}</robot>"


def written(folder: Path, *, file: str = FILE.format(""), description: str | None = None) -> Path:
    if description is None:
        description = urdf()
    (folder / "own.urdf").write_text(description)
    path = folder / "own.toml"
    path.write_text(file)
    return path


def test_a_file_says_what_a_value_is(tmp_path: Path) -> None:
    one = load_robot(written(tmp_path))
    assert (one.kind, one.joint_names, one.home) == ("own", ("first", "second"), (0.1, -0.2))
    assert (one.joints[1].speed, one.joints[1].acceleration) == (0.5, 3.0)
    assert one.stance("table").base == Base((0.3, 0.0, 0.5))
    assert one.stance("post") == one.stance("dishwasher")
    assert one.stance("post").base == Base((0.1, 0.0, 0.2))


def test_a_file_says_which_joints_open_and_close_the_gripper(tmp_path: Path) -> None:
    gripper = load_robot(written(tmp_path, file=fingers('joint = "first"').format(""))).gripper
    assert gripper.positions(0.5 * gripper.opening) == {"first": 0.02}
    assert (gripper.finger_names, gripper.jaw, gripper.made) == (("first",), "arm", False)


def test_a_path_and_a_name_are_told_apart(tmp_path: Path) -> None:
    path = written(tmp_path)
    own, ships = manipulator(RobotSection(model=str(path))), manipulator(RobotSection(model="panda"))
    assert own is not None
    assert ships is not None
    assert (own.kind, ships.kind) == ("own", "panda")
    assert manipulator(RobotSection()) is None
    assert scene_of(RobotSection(model=str(path), scene="table")).robot.kind == "own"
    assert scene_of(RobotSection()).robot.kind == "tiago"


@pytest.mark.parametrize(
    ("file", "match"),
    [
        (FILE.replace("[0.1, -0.2]", "[0.1]"), "home: 1 positions for 2 joints"),
        (FILE.format("posture = [1.0]\n"), r"\[stances.table\] posture: 1 positions for 2 joints"),
        (FILE.replace("two_fingers", "two_finger"), r"\[gripper\]: unknown key two_finger; did you mean two_fingers\?"),
        (FILE.replace('name = "own"', 'name = "My arm"'), "name"),
        (FILE.replace('link = "tip"\n', ""), "link"),
    ],
)
def test_what_is_wrong_in_a_file_is_one_line(tmp_path: Path, file: str, match: str) -> None:
    text = file if "{{" not in file else file.format("")
    with pytest.raises(ConfigurationError, match=match) as caught:
        load_robot(written(tmp_path, file=text))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("file", "description", "match"),
    [
        (FILE.replace('"tip"', '"tipp"'), urdf(), "link tipp, which the description has not: did you mean tip"),
        (FILE, urdf(mesh=MESH.format("hand.stl")), "mesh package://own/hand.stl is missing"),
        (FILE, urdf(limit=""), "joint second has no limits of position"),
        (FILE, urdf(limit='<limit lower="-1" upper="1" effort="1"/>'), ""),
        (FILE.replace("speed = 0.5", ""), urdf(limit='<limit lower="-1" upper="1" effort="1"/>'), "no limit of speed"),
        (FILE.replace('"second"', '"secnd"'), urdf(), "joint secnd is not in the description: did you mean second"),
        (fingers('joint = "fingr"'), urdf(), "the gripper's finger joint fingr is not in the description"),
        (fingers('joint = "first"', wide=0.0), urdf(), "the gripper's finger joint first does not move: give it two"),
        (fingers('joint = "first"', jaw="jaw"), urdf(), "the gripper's jaw is to be at link jaw"),
    ],
)
def test_what_does_not_fit_the_description_is_one_line(tmp_path: Path, file: str, description: str, match: str) -> None:
    section = RobotSection(model=str(written(tmp_path, file=file.format(""), description=description)))
    if not match:  # the file says the speed that the description does not
        assert manipulator(section) is not None
        return
    with pytest.raises(RobotUnfit, match=match) as caught:
        manipulator(section)
    assert "\n" not in str(caught.value)


def test_a_description_that_is_not_there_is_named(tmp_path: Path) -> None:
    path = written(tmp_path)
    (tmp_path / "own.urdf").unlink()
    with pytest.raises(FileMissing, match=r"own\.urdf is not there"):
        manipulator(RobotSection(model=str(path)))


def test_every_fault_is_said_not_the_first_alone(tmp_path: Path) -> None:
    file = FILE.replace('"tip"', '"tipp"').format("")
    one = load_robot(written(tmp_path, file=file, description=urdf(limit="", mesh=MESH.format("hand.stl"))))
    source = tmp_path / "own.urdf"
    said = list(faults.found(faults.parsed(source), one, source))
    assert [line.split()[0] for line in said] == ["joint", "the", "mesh"]
