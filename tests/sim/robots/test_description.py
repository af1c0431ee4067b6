import multiprocessing
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin
import pytest

from sim.robots.description import GRASPING_FRAME, RobotDescription, prepare

pytestmark = pytest.mark.sim


@pytest.fixture(scope="module")
def pinocchio_model(description: RobotDescription) -> pin.Model:
    return pin.buildModelFromUrdf(str(description.urdf))


@pytest.fixture(scope="module")
def mujoco_model(description: RobotDescription) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_path(str(description.urdf))


def _columns(pinocchio_model: pin.Model, mujoco_model: mujoco.MjModel) -> list[int]:
    """Where MuJoCo, which keeps the file's order, has the joints that Pinocchio sorts by name."""
    return [int(mujoco_model.joint(name).qposadr[0]) for name in pinocchio_model.names[1:]]


def _random_positions(model: pin.Model) -> np.ndarray:
    rng = np.random.default_rng(1)
    return rng.uniform(model.lowerPositionLimit, model.upperPositionLimit, (50, model.nq))


def test_both_readers_put_the_grasping_frame_in_the_same_place(pinocchio_model, mujoco_model) -> None:
    data, state = pinocchio_model.createData(), mujoco.MjData(mujoco_model)
    columns = _columns(pinocchio_model, mujoco_model)
    frame = pinocchio_model.getFrameId(GRASPING_FRAME)
    for q in _random_positions(pinocchio_model):
        pin.framesForwardKinematics(pinocchio_model, data, q)
        state.qpos[columns] = q
        mujoco.mj_kinematics(mujoco_model, state)
        body = state.body(GRASPING_FRAME)
        np.testing.assert_allclose(body.xpos, data.oMf[frame].translation, atol=1e-9)
        np.testing.assert_allclose(body.xmat.reshape(3, 3), data.oMf[frame].rotation, atol=1e-9)


def test_both_readers_find_the_same_mass_matrix(pinocchio_model, mujoco_model) -> None:
    data, state = pinocchio_model.createData(), mujoco.MjData(mujoco_model)
    columns = _columns(pinocchio_model, mujoco_model)
    mass = np.zeros((mujoco_model.nv, mujoco_model.nv))
    for q in _random_positions(pinocchio_model):
        expected = pin.crba(pinocchio_model, data, q)
        expected = np.triu(expected) + np.triu(expected, 1).T
        state.qpos[columns] = q
        mujoco.mj_forward(mujoco_model, state)
        mujoco.mj_fullM(mujoco_model, state, mass)
        np.testing.assert_allclose(mass[np.ix_(columns, columns)], expected, atol=1e-9)


def test_drawn_meshes_are_thin_enough_to_draw_quickly(mujoco_model: mujoco.MjModel) -> None:
    drawn = {int(geom) for geom in mujoco_model.geom_dataid[mujoco_model.geom_contype == 0] if geom >= 0}
    assert 10_000 < sum(int(mujoco_model.mesh_facenum[mesh]) for mesh in drawn) <= 20_000


def test_a_second_call_finds_what_the_first_made(description: RobotDescription) -> None:
    made = description.urdf.stat().st_mtime_ns
    assert prepare(description.urdf.parent.parent) == description
    assert description.urdf.stat().st_mtime_ns == made


def test_two_processes_at_once_leave_one_whole_description(tmp_path: Path) -> None:
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        first, second = pool.map(prepare, [tmp_path, tmp_path])
    assert first == second
    assert [folder.name for folder in tmp_path.iterdir()] == [first.urdf.parent.name]
    mujoco.MjModel.from_xml_path(str(first.urdf))
