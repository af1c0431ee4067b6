"""`retouch robot list`, `check` and `draw`: what a person reads, and which pictures lie there."""

import struct
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from services.cli import main
from services.commands.robot import check
from services.commands.robot.grasps import CELL, grasps
from sim.robots.catalogue import NAMES, robot
from sim.world.pictures import png

pytestmark = pytest.mark.sim

ARM = """
<mujoco><compiler angle="radian"/><worldbody><body name="foot">
  <geom type="cylinder" size="0.05 0.05" pos="0 0 0.05"/>
  <body name="turret" pos="0 0 0.12"><joint name="turn" axis="0 0 1" range="-3 3" limited="true"/>
    <geom type="sphere" size="0.05"/>
    <body name="upper"><joint name="lift" axis="0 1 0" range="-1.5 2.5" limited="true"/>
      <geom type="capsule" size="0.03 0.12" pos="0 0 0.15"/>
      <body name="fore" pos="0 0 0.3"><joint name="bend" axis="0 1 0" range="-2.5 2.5" limited="true"/>
        <geom type="capsule" size="0.025 0.1" pos="0 0 0.13"/>
        <body name="hand" pos="0 0 0.25"><joint name="tilt" axis="0 1 0" range="-2 2" limited="true"/>
          <geom type="box" size="0.02 0.02 0.02"/><site name="tool" pos="0 0 0.03"/>
        </body></body></body></body></body></worldbody></mujoco>
"""
FILE = """
name = "mine"
description = "mine.xml"
home = [0.0, 0.5, 1.0, 0.6]
turn_slack = 1.5
joints = [
  {name = "turn", speed = 2.0}, {name = "lift", speed = 2.0},
  {name = "bend", speed = 2.0}, {name = "tilt", speed = 2.0},
]
[gripper]
link = "tool"
rpy = [0.0, -1.5707963, 0.0]
two_fingers = true
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "mine.xml").write_text(ARM)
    path = tmp_path / "mine.toml"
    path.write_text(FILE)
    return path


def pictured(path: Path) -> tuple[int, int]:
    """Width and height of a picture [px]."""
    content = path.read_bytes()
    assert content.startswith(b"\x89PNG")
    width, height = struct.unpack(">II", content[16:24])
    return width, height


def test_the_list_has_every_robot_on_a_line(capsys) -> None:
    assert main(["robot", "list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split(":")[0].split()[0] for line in lines] == list(NAMES)
    assert lines[0].startswith("tiago (default): 8 joints")


def test_a_robot_of_a_persons_own_is_measured_and_drawn(file: Path, tmp_path: Path, capsys, monkeypatch) -> None:
    monkeypatch.setattr(check, "grasps", partial(grasps, cell=0.3))
    assert main(["robot", "check", str(file), "--out", str(tmp_path / "pictures")]) == 0
    said = capsys.readouterr().out
    assert "reach: lower = " in said
    assert "scene table: no motion can start at (0.600, -0.330, 0.740) m: the robot does not reach it" in said
    assert pictured(tmp_path / "pictures" / "mine.png") == pictured(tmp_path / "pictures" / "mine-reach.png")


def test_every_thing_that_is_missing_is_a_line_and_nothing_is_drawn(file: Path, tmp_path: Path, capsys) -> None:
    file.write_text(FILE.replace('"tool"', '"tol"').replace('"tilt", speed = 2.0', '"tilt"'))
    assert main(["robot", "check", str(file), "--out", str(tmp_path / "pictures")]) == 2
    assert capsys.readouterr().out.splitlines() == [
        "joint tilt has no limit of speed: give it speed",
        "the gripper is to be at link tol, which the description has not: did you mean tool?",
    ]
    assert not (tmp_path / "pictures").exists()


def test_a_home_that_is_no_posture_is_said(file: Path, tmp_path: Path, capsys) -> None:
    file.write_text(FILE.replace("[0.0, 0.5, 1.0, 0.6]", "[4.0, 0.5, 1.0, 0.6]"))
    assert main(["robot", "check", str(file), "--out", str(tmp_path)]) == 2
    assert "home: joint turn at 4 is outside its limits, -3 to 3" in capsys.readouterr().out
    assert pictured(tmp_path / "mine.png")
    assert not (tmp_path / "mine-reach.png").exists(), "a map from there would tell nothing"


def test_a_box_that_is_smaller_than_the_reach_is_said(file: Path, tmp_path: Path, capsys) -> None:
    file.write_text(f"{FILE}[reach]\nlower = [-0.2, -1.0, -1.0]\nupper = [1.0, 1.0, 1.2]\n")
    assert main(["robot", "check", str(file), "--out", str(tmp_path)]) == 2
    assert "reach: it goes beyond [-0.2, -1.0, -1.0] to [1.0, 1.0, 1.2] m" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("which", "said"),
    [
        ("pandaa", "unknown robot 'pandaa': use one of tiago, panda"),
        ("there/is/none.toml", "none.toml: No such file or directory"),
    ],
)
def test_a_robot_that_there_is_not_is_one_line(which: str, said: str, capsys) -> None:
    assert main(["robot", "draw", which]) == 2
    line = capsys.readouterr().err
    assert said in line
    assert line.count("\n") == 1


def test_a_run_with_such_a_robot_does_not_begin(file: Path, capsys) -> None:
    file.write_text(FILE.replace('"tool"', '"tol"'))
    assert main(["up", "--headless", "--once", "--robot-model", str(file)]) == 2
    assert "robot mine: the gripper is to be at link tol" in capsys.readouterr().err
    assert main(["up", "--headless", "--once", "--scene", "particle", "--robot-model", "ur5"]) == 2
    assert "scene particle has a robot of its own" in capsys.readouterr().err


def test_where_it_can_grasp_lies_in_two_planes_through_home() -> None:
    cell = 2.0 * CELL
    found = grasps(robot("so101"), cell)
    cells = np.round(found.places / cell).astype(int)
    assert len(set(map(tuple, cells.tolist()))) == len(cells)
    level = set(cells[cells[:, 1] != 0, 2].tolist())
    assert len(level) == 1
    assert 0.0 < found.share < 1.0


def test_a_picture_is_a_file_that_others_read() -> None:
    cv2 = pytest.importorskip("cv2")
    image = np.random.default_rng(0).integers(0, 256, (5, 7, 3)).astype(np.uint8)
    read = cv2.imdecode(np.frombuffer(png(image), np.uint8), cv2.IMREAD_COLOR)
    np.testing.assert_array_equal(read[:, :, ::-1], image)
