"""The robot's shape moves as the SDK would move it."""

import numpy as np
import pytest

pytestmark = pytest.mark.sim


def test_the_joints_move_as_the_sdk_says():
    import pyarrow as pa
    import rerun as rr

    from services.viewer.robot_model import _Joints
    from sim.robots.catalogue import DEFAULT
    from sim.robots.description import prepare

    tree = rr.urdf.UrdfTree.from_file_path(prepare().urdf)
    q = np.linspace(-0.5, 0.4, len(DEFAULT.joint_names))
    translations, quaternions = _Joints(tree, DEFAULT.joint_names).transforms(q)
    expected = tree.compute_joint_transform_batches(pa.array([list(DEFAULT.joint_names)]), pa.array([q])).flatten()
    np.testing.assert_allclose(translations, expected.field("translation").to_pylist(), atol=1e-6)
    dots = np.sum(quaternions * np.array(expected.field("quaternion").to_pylist()), axis=1)
    np.testing.assert_allclose(np.abs(dots), 1.0, atol=1e-6)
