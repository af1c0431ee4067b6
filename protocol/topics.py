"""The topic registry: every channel, once, as data. Everything else is derived from it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property, lru_cache
from typing import Any, Generic, TypeVar

from protocol import messages
from protocol.names import checked_name, is_name, role

M = TypeVar("M", bound=messages.Message)

VERSION = "@v1"
"""The verbatim chunk keeps versions apart: no wildcard of one version matches another."""


class QoS(Enum):
    """How a topic travels, named by stance; the bus translates it.

    SAFETY: before everything else, at once; every message counts, however late and whatever its stamp.
    REALTIME: the newest sample only, at once, rather lost than late.
    STATE: the newest sample only, ahead of pictures.
    PICTURE: large, the newest only, behind everything that moves.
    EVENT: every message counts, however late; its publisher repeats what must not be lost.
    """

    SAFETY = "safety"
    REALTIME = "realtime"
    STATE = "state"
    PICTURE = "picture"
    EVENT = "event"


@dataclass(frozen=True)
class Topic(Generic[M]):
    """A channel of one message type, or a family of them.

    Attributes:
        name: "<class>/<subject>"; access rules name the class: cmd, state, model, cam, safety, authority, health. That
            of a family ends in "/*", where the name of each of its members stands; see `of`.
        type: of its messages.
        rate_hz: at which it is published in operation; timeouts are multiples of its period.
        qos: how it travels.
        publisher: the process that publishes it; "any" where every process may.
        max_bytes: of an encoded message.
        about: one line for people.
        kept: messages that a receiver keeps until it takes them; 1 where only the newest counts.
        readers: the robot's own processes that read it, by their roles; people's processes may read everything.
        outdated: a sample that comes late counts for nothing, of a topic that is no event and no stop.
    """

    name: str
    type: type[M]
    rate_hz: float
    qos: QoS
    publisher: str
    max_bytes: int
    about: str
    kept: int = 1
    readers: tuple[str, ...] = ()
    outdated: bool = True

    @cached_property
    def schema(self) -> str:
        """Announced with every message, so that a reader can refuse another version before it decodes."""
        return f"{self.type.__name__}/1"

    @cached_property
    def stale_after_ns(self) -> int | None:
        """Age at which a sample counts as lost: ten periods, at least 100 ms; events and stops never."""
        if self.qos in (QoS.EVENT, QoS.SAFETY) or not self.outdated:
            return None
        return int(max(0.1, 10.0 / self.rate_hz) * 1e9)

    def of(self, member: str) -> Topic[M]:
        """The channel of one member of the family; raises InvalidName where that cannot stand in a key expression."""
        return replace(self, name=self.name.removesuffix("*") + checked_name(member))

    def published_by(self, process: str) -> bool:
        """Whether a process of this name publishes the topic: one of the role that the table names."""
        return publishes(self.publisher, process)

    def key(self, robot: str, source: str) -> str:
        """The key expression on which `source` publishes for `robot`."""
        return source_key(robot, self.name, source)


@lru_cache(maxsize=1024)  # asked with every message; bounded as below
def source_key(robot: str, name: str, source: str) -> str:
    """See `Topic.key`."""
    return f"retouch/{VERSION}/{checked_name(robot)}/{name}/{source if source == '*' else checked_name(source)}"


@lru_cache(maxsize=1024)  # asked of every message, about few names; bounded, since a stranger may invent more
def publishes(publisher: str, process: str) -> bool:
    """See `Topic.published_by`."""
    return is_name(process) and publisher in ("any", role(process))


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
    "state/robot", messages.RobotState, 100.0, QoS.STATE, "robot", 49_152, "joints and poses, measured and commanded"
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
