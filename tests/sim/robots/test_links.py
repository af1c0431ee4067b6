"""The robot's links as whoever draws it has them."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from sim.exceptions import DescriptionInvalid
from sim.robots.catalogue import DEFAULT
from sim.robots.description import GRASPING_FRAME, RobotDescription
from sim.robots.links import GREY, Block, Cylinder, Mesh, read_links

pytestmark = pytest.mark.sim

HEAD = '<robot name="r">'
BASE = '<link name="base"/>'


def written(tmp_path: Path, *elements: str) -> Path:
    path = tmp_path / "robot.urdf"
    path.write_text(f"{HEAD}{''.join(elements)}</robot>")
    return path


def test_every_link_comes_after_the_one_that_it_hangs_on(description: RobotDescription) -> None:
    links = read_links(description.urdf)
    before: set[str] = {""}
    for link in links:
        assert link.parent in before
        before.add(link.name)
    assert GRASPING_FRAME in before


def test_what_moves_are_the_arm_the_head_and_the_fingers(description: RobotDescription) -> None:
    links = read_links(description.urdf)
    assert {link.joint for link in links} - {""} == set(DEFAULT.moving_names)
    assert [link.joint for link in links if link.slides] == ["torso_lift_joint", *DEFAULT.gripper.finger_names]


def test_a_link_looks_as_its_description_says(description: RobotDescription) -> None:
    links = {link.name: link for link in read_links(description.urdf)}
    (finger,) = links["gripper_left_finger_link"].shapes
    assert finger.form == Block((0.098, 0.012, 0.022))
    assert finger.colour == (0.7, 0.7, 0.7, 1.0)
    forms = [type(shape.form) for link in links.values() for shape in link.shapes]
    assert (forms.count(Mesh), forms.count(Block), forms.count(Cylinder)) == (24, 5, 3)


def test_an_origin_turns_about_fixed_axes(tmp_path: Path) -> None:
    joint = '<joint name="j" type="fixed"><parent link="base"/><child link="tip"/><origin rpy="0.3 -0.7 1.1"/></joint>'
    _, tip = read_links(written(tmp_path, BASE, '<link name="tip"/>', joint))
    expected = np.zeros(4)
    mujoco.mju_euler2Quat(expected, np.array([0.3, -0.7, 1.1]), "XYZ")
    np.testing.assert_allclose(tip.origin.orientation, expected, atol=1e-12)
    np.testing.assert_array_equal(tip.origin.position, np.zeros(3))


def test_what_has_no_colour_is_grey_and_a_joint_without_an_axis_turns_about_x(tmp_path: Path) -> None:
    look = '<visual><geometry><box size="1 2 3"/></geometry></visual>'
    joint = '<joint name="j" type="revolute"><parent link="base"/><child link="tip"/></joint>'
    _, tip = read_links(written(tmp_path, joint, f'<link name="tip">{look}</link>', BASE))
    assert tip.shapes[0].colour == GREY
    assert tip.axis.tolist() == [1.0, 0.0, 0.0]


@pytest.mark.parametrize(
    ("elements", "match"),
    [
        (('<joint name="j" type="fixed"><parent link="tip"/><child link="tip"/></joint>', '<link name="tip"/>'), "tip"),
        (('<link name="a"><visual><geometry><sphere radius="1"/></geometry></visual></link>',), "neither"),
        (('<link name="a"><visual><geometry><box size="1 2"/></geometry></visual></link>',), "2 numbers, not 3"),
    ],
)
def test_what_cannot_be_drawn_is_refused(tmp_path: Path, elements: tuple[str, ...], match: str) -> None:
    with pytest.raises(DescriptionInvalid, match=match):
        read_links(written(tmp_path, *elements))
