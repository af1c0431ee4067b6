"""The topic registry: every channel, once, as data. Everything else is derived from it."""

from __future__ import annotations

from typing import Any

from protocol import messages
from protocol.topic import QoS, Topic

OPERATOR_INPUT = Topic(  # kept: between two steps of the master another station must not hide its own
    "cmd/operator_input",
    messages.OperatorInput,
    50.0,
    QoS.REALTIME,
    "station",
    15_360,
    "who is at the page, and what is held there",
    kept=8,
)
MASTER_STATE = Topic(  # kept: between two steps of the robot a master without authority must not hide the holder's
    "cmd/master_state",
    messages.MasterState,
    100.0,
    QoS.REALTIME,
    "master",
    4_608,
    "the operator's correction",
    kept=8,
    readers=("robot",),
)
AUTHORITY_RENEWAL = Topic(
    "authority/renewal",
    messages.AuthorityRenewal,
    50.0,
    QoS.STATE,
    "station",
    1_536,
    "an operator is present",
    kept=8,
    readers=("robot",),
)
AUTHORITY_REQUEST = Topic(
    "authority/request",
    messages.AuthorityRequest,
    10.0,
    QoS.STATE,
    "station",
    1_536,
    "asks who commands",
    kept=8,
    readers=("robot",),
)
AUTHORITY_STATE = Topic(
    "authority/state", messages.AuthorityState, 10.0, QoS.STATE, "robot", 3_584, "who may command, and who asks to"
)
EMERGENCY_STOP = Topic(  # kept: no flood brings so many in a control period that a press is lost among them
    "safety/emergency_stop",
    messages.EmergencyStop,
    50.0,
    QoS.SAFETY,
    "any",
    20_480,
    "stop, repeated while pressed",
    kept=256,
    readers=("robot",),
)
SAFETY_STATE = Topic(
    "safety/state", messages.SafetyState, 10.0, QoS.STATE, "robot", 20_480, "what keeps the robot from moving"
)
ROBOT_STATE = Topic(
    "state/robot",
    messages.RobotState,
    100.0,
    QoS.STATE,
    "robot",
    49_152,
    "joints and poses, measured and commanded",
    readers=("camera",),
)
WORLD_STATE = Topic(
    "state/world",
    messages.WorldState,
    50.0,
    QoS.STATE,
    "robot",
    16_384,
    "the simulated world, to draw",
    readers=("camera",),
)
SCENE_STATE = Topic(
    "state/scene",
    messages.SceneState,
    1.0,
    QoS.STATE,
    "robot",
    262_144,
    "the scene and its success criteria",
    readers=("camera", "model"),
)
VERDICT = Topic("state/verdict", messages.Verdict, 30.0, QoS.STATE, "robot", 2_048, "reached, kicked over, collision")
EXECUTION = Topic("state/execution", messages.ExecutionState, 10.0, QoS.STATE, "robot", 1_024, "the motion under way")
EPISODE_RESULT = Topic(
    "state/episode_result",
    messages.EpisodeResult,
    1.0,
    QoS.EVENT,
    "robot",
    2_097_152,
    "what became of an episode",
    kept=16,
)
CAMERA_IMAGE = Topic(  # kept: one that others need must not be lost between two steps of who decodes them
    "cam/image/*",
    messages.CameraImage,
    15.0,
    QoS.PICTURE,
    "camera",
    1_048_576,
    "what each camera sees",
    kept=32,
    readers=("perception",),
)
POINT_CLOUD = Topic(
    "cam/cloud", messages.PointCloud, 5.0, QoS.PICTURE, "camera", 73_728, "surfaces that a camera with depth sees"
)
DEPTH = Topic(
    "cam/depth",
    messages.DepthPicture,
    5.0,
    QoS.PICTURE,
    "camera",
    1_048_576,
    "how far away is what that camera sees",
    readers=("perception",),
)
PICTURE_QUEUE = Topic(
    "cam/queue",
    messages.PictureQueue,
    5.0,
    QoS.STATE,
    "any",
    1_024,
    "how late pictures come to who looks, and what s/he needs",
    kept=64,
    readers=("camera",),
)
OBJECT_POSE = Topic(
    "state/object_pose", messages.ObjectPose, 15.0, QoS.STATE, "perception", 1_536, "object as seen", readers=("robot",)
)
PREDICTION = Topic(
    "model/prediction",
    messages.Prediction,
    1.0,
    QoS.EVENT,
    "model",
    1_048_576,
    "the newest prediction, how much of it is known, and which way it takes",
    kept=16,
    readers=("robot",),
)
MODEL_STATE = Topic("model/state", messages.ModelState, 1.0, QoS.STATE, "model", 2_048, "the model as it lies on disk")
TEACHING_STATE = Topic(
    "state/teaching", messages.TeachingState, 10.0, QoS.STATE, "station", 262_144, "where the teaching workflow stands"
)
ATTENDANCE = Topic(
    "state/attendance", messages.Attendance, 10.0, QoS.STATE, "station", 8_192, "who is at a station's page", kept=16
)
RECORDING = Topic(
    "state/recording", messages.Recording, 1.0, QoS.STATE, "viewer", 57_344, "where to look and what records"
)
HEARTBEAT = Topic(
    "health/heartbeat", messages.Heartbeat, 2.0, QoS.STATE, "any", 81_920, "a process about itself", kept=256
)
PROBE = Topic(
    "health/probe",
    messages.Probe,
    100.0,
    QoS.REALTIME,
    "cli",
    1_024,
    "a diagnosis asks the way, as control travels",
    kept=512,
    outdated=False,
)
LOAD = Topic(
    "health/load",
    messages.Probe,
    15.0,
    QoS.PICTURE,
    "cli",
    8_192,
    "the same, as pictures travel",
    kept=512,
    outdated=False,
)

TOPICS: tuple[Topic[Any], ...] = (
    OPERATOR_INPUT,
    MASTER_STATE,
    AUTHORITY_RENEWAL,
    AUTHORITY_REQUEST,
    AUTHORITY_STATE,
    EMERGENCY_STOP,
    SAFETY_STATE,
    ROBOT_STATE,
    WORLD_STATE,
    SCENE_STATE,
    VERDICT,
    EXECUTION,
    EPISODE_RESULT,
    CAMERA_IMAGE,
    POINT_CLOUD,
    DEPTH,
    PICTURE_QUEUE,
    OBJECT_POSE,
    PREDICTION,
    MODEL_STATE,
    TEACHING_STATE,
    ATTENDANCE,
    RECORDING,
    HEARTBEAT,
    PROBE,
    LOAD,
)
