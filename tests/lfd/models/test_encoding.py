from dataclasses import replace

import numpy as np
import pytest

from lfd.models.anchor import Anchor
from lfd.models.basis import GaussianBasis
from lfd.models.encoding import Encoding, reference_rotation
from lfd.motion.demonstration import Situation
from lfd.motion.rotations import exp_map, multiply
from lfd.motion.trajectory import Trajectory


@pytest.fixture
def demonstration(reach):
    return reach([0.9, 0.2, 0.6], bend=0.1)


def there_and_back(encoding, demonstration):
    x = encoding.encode(demonstration)
    return encoding.decode(x, demonstration.situation, demonstration.trajectory.n_points)


@pytest.mark.parametrize("anchor", [None, Anchor.straight(), Anchor(np.full(6, 0.1), 0.7 * np.eye(6))])
def test_a_smooth_motion_survives_there_and_back(demonstration, anchor):
    encoding = Encoding(GaussianBasis(20, 0.05), 75, reference_rotation([demonstration]), anchor)
    back = there_and_back(encoding, demonstration)
    np.testing.assert_allclose(back.positions, demonstration.trajectory.positions, atol=5e-3)
    np.testing.assert_allclose(back.orientations, demonstration.trajectory.orientations, atol=5e-3)
    assert back.duration == pytest.approx(demonstration.trajectory.duration)


def test_an_anchored_motion_begins_at_the_start_pose_whatever_the_weights(demonstration, rng):
    encoding = Encoding(GaussianBasis(10, 0.1), 75, reference_rotation([demonstration]), anchor=Anchor.straight())
    start = rng.normal(size=3), exp_map(rng.normal(size=3))
    decoded = encoding.decode(rng.normal(size=61), Situation.reaching(demonstration.origin, *start), 30)
    np.testing.assert_allclose(decoded.positions[0], start[0], atol=1e-12)
    assert abs(decoded.orientations[0] @ start[1]) == pytest.approx(1.0)


def test_the_sign_of_the_quaternions_does_not_matter(demonstration):
    trajectory = demonstration.trajectory
    flipped = replace(demonstration, trajectory=Trajectory(trajectory.positions, -trajectory.orientations, 5.0))
    encoding = Encoding(GaussianBasis(10, 0.1), 10, reference_rotation([demonstration]), anchor=None)
    np.testing.assert_allclose(encoding.encode(flipped), encoding.encode(demonstration), atol=1e-12)


def test_a_common_rotation_of_motion_and_reference_changes_nothing(demonstration):
    turn = exp_map(np.array([0.0, 0.0, 2.5]))
    trajectory = demonstration.trajectory
    turned = replace(
        demonstration, trajectory=Trajectory(trajectory.positions, multiply(turn, trajectory.orientations), 5.0)
    )
    encodings = [
        Encoding(GaussianBasis(10, 0.1), 10, reference_rotation([d]), anchor=None).encode(d)
        for d in (demonstration, turned)
    ]
    np.testing.assert_allclose(encodings[0], encodings[1], atol=1e-9)
