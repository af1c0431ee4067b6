"""Sound messages with extreme values, as hypothesis strategies: what the codec lets through, sensible or not."""

import cv2
import numpy as np
from hypothesis import strategies as st

from protocol.messages import (
    MOST_AFTER_KEY,
    Array,
    Attempt,
    AuthorityState,
    Box,
    CameraImage,
    Coding,
    Controller,
    DepthPicture,
    Light,
    MasterState,
    Mode,
    ModelState,
    Motion,
    ObjectPose,
    OperatorInput,
    Outcome,
    Phase,
    PointCloud,
    Pose,
    Prediction,
    RobotState,
    SafetyState,
    SceneState,
    TeachingState,
    Verdict,
    WorldState,
)
from services.bus.depth import depth_to_wire

reals = st.sampled_from((0.0, -0.0, 1.0, -1.0, 5e-324, 1e-12, 1e9, -1e9, 3.14159, 1e6)) | st.floats(-1e9, 1e9)
counts = st.sampled_from((0, 1, 7, 2**32, 2**53))
names = st.sampled_from(("", "head", "dishwasher", "nowhere", "\0", "x" * 64, "[/]%s{}", "../..", "é\U0001f916"))
texts = names | st.just("long " * 800)
vectors = st.tuples(reals, reals, reals)
_angles = st.floats(-10.0, 10.0)
orientations = st.builds(lambda angle: (float(np.cos(angle)), 0.0, float(np.sin(angle)), 0.0), _angles)
poses = st.builds(Pose, vectors, orientations)

_specials = (0.0, 1.0, -1e308, 1e308, float("nan"), float("inf"), 1e-308)


@st.composite
def arrays(draw, shapes):
    """An array of one of the shapes, of ordinary, huge or no numbers."""
    shape = draw(st.sampled_from(shapes))
    value = draw(st.sampled_from(_specials) | st.floats(-10.0, 10.0))
    return Array("<f8", shape, np.full(shape, value).tobytes())


def motions():
    """Motions of two way-points and of the most that there may be."""
    return st.builds(
        lambda n, position: Motion(
            Array("<f8", (n, 3), np.full((n, 3), position).tobytes()),
            Array("<f8", (n, 4), np.tile([1.0, 0.0, 0.0, 0.0], (n, 1)).tobytes()),
            5.0,
        ),
        st.sampled_from((2, 3, 10_000)),
        st.sampled_from(_specials),
    )


def _jpeg(height, width):
    return cv2.imencode(".jpg", np.zeros((height, width, 3), dtype=np.uint8))[1].tobytes()


def _marker():
    """A marker of 60 pixels in the middle of a picture."""
    picture = np.full((240, 320), 200, dtype=np.uint8)
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    picture[90:150, 130:190] = cv2.aruco.generateImageMarker(dictionary, 7, 60)
    return cv2.imencode(".jpg", picture)[1].tobytes()


pictures = st.just(_marker()) | st.sampled_from(
    (b"", b"\xff\xd8", b"no picture", _jpeg(1, 1), _jpeg(1, 640), _jpeg(64, 64), _jpeg(240, 320)[:-9])
)

fours = st.tuples(reals, reals, reals, reals)
boxes = st.builds(Box, names, vectors, vectors, fours, fours)

robots = st.builds(
    RobotState,
    joint_names=st.sampled_from(((), ("arm_1_joint",), ("arm_1_joint",) * 3, ("a", "b"), ("x" * 64,) * 64)),
    q=st.lists(reals, max_size=64).map(tuple),
    measured=poses,
    reference=poses,
    phase=st.sampled_from(Phase),
    episode=counts,
    offset=vectors,
    turn=vectors,
    hold_reason=texts,
    applied_latency=reals,
    applied_way=reals,
    following_lag=reals,
    ahead=st.none() | reals,
)
worlds = st.builds(
    WorldState, time=reals, qpos=arrays(((), (0,), (3,), (5,), (49,), (7, 7), (1, 1, 1, 1))), object_pose=poses
)
scenes = st.builds(
    SceneState,
    name=names,
    variant=st.sampled_from(("", "b1", "b2", "none", "clear")),
    boxes=st.lists(boxes, max_size=3).map(tuple),
    object_size=vectors,
    ellipsoid_radii=vectors,
    kicked_over_thresholds=vectors,
    kicked_over_tilt=reals,
    start=poses,
    object_region=st.tuples(vectors, vectors).map(
        lambda corners: (tuple(map(min, *corners)), tuple(map(max, *corners)))
    ),
)
images = st.builds(
    CameraImage,
    camera=names,
    width=counts,
    height=counts,
    data=pictures,
    intrinsics=fours,
    pose=poses,
    captured_ns=counts,
    object_pose=st.none() | poses,
    coding=st.sampled_from(Coding),
    after_key=st.integers(0, 3) | st.just(MOST_AFTER_KEY),
)
clouds = st.builds(
    PointCloud, camera=names, data=st.binary(max_size=40) | st.just(b"\x80" * 72_000), captured_ns=counts
)
depths = st.builds(
    DepthPicture,
    camera=names,
    width=st.integers(0, 20) | counts,
    height=st.integers(0, 20) | counts,
    data=st.binary(max_size=60) | st.just(depth_to_wire(np.ones((12, 16)))),
    intrinsics=st.tuples(reals, reals, reals, reals),
    pose=poses,
    captured_ns=counts,
)
masters = st.builds(MasterState, force=vectors, displacement=vectors)
object_poses = st.builds(ObjectPose, pose=poses, tag=counts, error=reals, rejected=counts, pictures=counts)
verdicts = st.builds(
    Verdict,
    reached=st.booleans(),
    kicked_over=st.booleans(),
    collision=st.booleans(),
    collision_position=st.none() | vectors,
    collision_force=reals,
    ellipsoid_value=reals,
    object_displacement=vectors,
    object_tilt=reals,
    missed=reals,
)
predictions = st.builds(
    Prediction,
    id=counts,
    motion=motions(),
    deviations=arrays(((), (0,), (2, 3), (3, 3), (3, 5), (10_000, 3))),
    model_version=counts,
    object_position=vectors,
)
_readings = st.floats(-1e3, 1e3)
_controllers = st.builds(
    Controller,
    kind=names,
    number=st.sampled_from((0, 99)),
    axes=st.lists(_readings, max_size=16).map(tuple),
    buttons=st.lists(st.floats(0.0, 1.0), max_size=32).map(tuple),
)
inputs = st.builds(
    OperatorInput,
    operator=names,
    holder=names,
    present=st.booleans(),
    keys=st.lists(names, max_size=32).map(tuple),
    focused=st.booleans(),
    controllers=st.lists(_controllers, max_size=4).map(tuple),
)
authorities = st.builds(AuthorityState, operator=names, holder=names, epoch=counts, expires_in=reals)
safeties = st.builds(
    SafetyState,
    emergency_stop=st.booleans(),
    by=names,
    reason=texts,
    released_by=names,
    standing=st.booleans(),
    self_distance=reals,
)
models = st.builds(ModelState, kind=names, version=counts, demonstrations=counts, updates=counts, scene=names)
_outcomes = st.builds(Outcome, st.booleans(), st.booleans(), st.booleans())
attempts = st.builds(
    Attempt,
    scene=names,
    object_position=vectors,
    model_version=counts,
    operator_input=st.booleans(),
    verdict=_outcomes,
    duration_s=reals,
    variant=names,
    mode=st.sampled_from(Mode),
    number=counts,
)
teachings = st.builds(
    TeachingState,
    phase=names,
    text=texts,
    light=st.sampled_from(Light),
    refinements=counts,
    refinements_allowed=counts,
    updates=counts,
    updates_allowed=counts,
    attempts=st.lists(attempts, max_size=3).map(tuple),
    reason=texts,
)
