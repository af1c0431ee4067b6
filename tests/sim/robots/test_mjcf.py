"""A robot whose description is for MuJoCo: its URDF moves as it does."""

import xml.etree.ElementTree as ET
from pathlib import Path

import mujoco
import numpy as np
import pytest

from sim.exceptions import DescriptionInvalid
from sim.robots import inertia
from sim.robots.mjcf import converted, is_mjcf

pytestmark = pytest.mark.sim

ARM = """
<mujoco><compiler angle="radian"/><worldbody><body name="foot" pos="0.1 0 0.2" euler="0 0 0.4">
  <geom type="cylinder" size="0.05 0.1" rgba="0.2 0.4 0.6 1"/>
  <body name="upper" pos="0 0.1 0.3" quat="0.9 0.1 0.3 0.2">
    <joint name="a" axis="0 1 0" pos="0.02 0.01 -0.05" range="-1 2" limited="true"/>
    <joint name="b" axis="1 0 0.5" pos="0 0.03 0" range="-1 1" limited="true"/>
    <geom type="capsule" size="0.03 0.1" pos="0 0 0.1"/>
    <body name="fore" pos="0 0 0.25" euler="0 1.5707963267948966 0">
      <joint name="c" type="slide" axis="0 0 1" range="0 0.2" limited="true"/>
      <geom type="box" size="0.02 0.03 0.1" mass="0.7"/><site name="tool" pos="0.01 0 0.12" euler="0.3 0 0"/>
    </body></body></body></worldbody></mujoco>
"""


def written(folder: Path, text: str = ARM) -> Path:
    path = folder / "arm.xml"
    path.write_text(text)
    return path


def test_bodies_and_sites_are_where_mujoco_has_them_in_any_posture(tmp_path: Path) -> None:
    path = written(tmp_path)
    tree = ET.parse(converted(path, tmp_path / "cache"))
    inertia.give_where_needed(tree.getroot())
    tree.write(tmp_path / "arm.urdf")
    one = mujoco.MjModel.from_xml_path(str(path))
    spec = mujoco.MjSpec.from_file(str(tmp_path / "arm.urdf"))
    spec.compiler.fusestatic = False
    two = spec.compile()
    rng = np.random.default_rng(0)
    for _ in range(20):
        first, second = mujoco.MjData(one), mujoco.MjData(two)
        for name in ("a", "b", "c"):
            first.joint(name).qpos[0] = second.joint(name).qpos[0] = rng.uniform(*one.joint(name).range)
        mujoco.mj_forward(one, first)
        mujoco.mj_forward(two, second)
        for body in ("foot", "upper", "fore"):
            np.testing.assert_allclose(first.body(body).xpos, second.body(body).xpos, atol=1e-9)
            np.testing.assert_allclose(first.body(body).xmat, second.body(body).xmat, atol=1e-9)
        np.testing.assert_allclose(first.site("tool").xpos, second.body("tool").xpos, atol=1e-9)
    assert two.body("fore").mass[0] == pytest.approx(0.7)


def test_what_is_no_mjcf_is_told_by_its_first_element(tmp_path: Path) -> None:
    assert is_mjcf(written(tmp_path))
    assert not is_mjcf(written(tmp_path, "<robot/>"))
    assert not is_mjcf(written(tmp_path, "nothing"))


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("<mujoco><worldbody><body><freejoint/><geom size='1'/></body></worldbody></mujoco>", "free"),
        ("<mujoco><worldbody><nonsense/></worldbody></mujoco>", "nonsense"),
    ],
)
def test_what_is_no_arm_is_refused_in_one_line(tmp_path: Path, text: str, match: str) -> None:
    with pytest.raises(DescriptionInvalid, match=match) as caught:
        converted(written(tmp_path, text), tmp_path / "cache")
    assert "\n" not in str(caught.value)
