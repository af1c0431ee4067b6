"""Depth pictures on the wire: to the millimetre, and whatever else comes is none."""

import cv2
import numpy as np
import pytest

from protocol.messages import DepthPicture, Pose
from services.bus.depth import FARTHEST_M, depth_from_wire, depth_to_wire

HERE = Pose((0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 0.0))
DEPTH = np.random.default_rng(2).uniform(0.3, 5.0, (12, 16))


def picture(data, width=16, height=12):
    return DepthPicture(camera="head", width=width, height=height, data=data, intrinsics=(1.0,) * 4, pose=HERE)


def test_a_depth_picture_comes_as_it_was_sent_to_half_a_millimetre():
    np.testing.assert_allclose(depth_from_wire(picture(depth_to_wire(DEPTH))), DEPTH, atol=0.00051)


@pytest.mark.parametrize("unknown", [np.inf, np.nan, 0.0, -1.0, FARTHEST_M + 1.0])
def test_what_is_not_known_or_too_far_is_infinitely_far(unknown):
    depth = DEPTH.copy()
    depth[3, 4] = unknown
    came = depth_from_wire(picture(depth_to_wire(depth)))
    assert np.isinf(came[3, 4])
    assert np.isfinite(came).sum() == DEPTH.size - 1


def test_what_is_no_depth_picture_of_that_size_is_none():
    whole = depth_to_wire(DEPTH)
    colours = cv2.imencode(".png", np.zeros((12, 16, 3), np.uint8))[1].tobytes()
    jpeg = cv2.imencode(".jpg", np.zeros((12, 16), np.uint8))[1].tobytes()
    for data in (b"", b"no picture", whole[:20], whole[:40], colours, jpeg):
        assert depth_from_wire(picture(data)) is None
    assert depth_from_wire(picture(whole, width=17)) is None
    claims = whole[:16] + (2**31 - 1).to_bytes(4, "big") + whole[20:]
    assert depth_from_wire(picture(claims, width=2**31 - 1)) is None, "nothing is made of what it says of its size"
