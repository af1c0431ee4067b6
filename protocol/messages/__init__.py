"""The messages: frozen structs that travel as MessagePack maps.

Units are SI, angles radians, frames stand in the field's name (`base` where nothing else is said), quaternions are
scalar first (w, x, y, z). A new field needs a default; any other change to a message needs the next `@v` in the key.
Numbers are bounded, so that a NaN or an infinity never passes the codec.
"""

from protocol.messages.attendance import Attendance, Person, Role, TakeOver
from protocol.messages.authority import (
    SHORTEST_REASON,
    SILENCE_GIVES_S,
    AuthorityEvent,
    AuthorityRenewal,
    AuthorityRequest,
    AuthorityState,
)
from protocol.messages.camera import CameraImage
from protocol.messages.command import Controller, MasterState, OperatorInput, Trouble
from protocol.messages.health import Figure, Heartbeat, TopicFigures
from protocol.messages.model import MOST_WAYPOINTS, Method, ModelState, Origin, Prediction, Purpose, Way
from protocol.messages.safety import EmergencyStop, SafetyState
from protocol.messages.state import (
    Box,
    Cut,
    EpisodeResult,
    ExecutionState,
    Mode,
    ObjectPose,
    Phase,
    RobotState,
    SceneState,
    Verdict,
    WorldState,
)
from protocol.messages.teaching import Attempt, Light, Outcome, Recording, TeachingState
from protocol.messages.values import (
    ITEM_SIZES,
    LONGEST_REASON,
    Array,
    Condition,
    Count,
    Duration,
    Fraction,
    Joints,
    Message,
    Motion,
    Name,
    Part,
    Pose,
    Quaternion,
    Real,
    Reason,
    Text,
    Vector3,
)

__all__ = [
    "ITEM_SIZES",
    "LONGEST_REASON",
    "MOST_WAYPOINTS",
    "SHORTEST_REASON",
    "SILENCE_GIVES_S",
    "Array",
    "Attempt",
    "Attendance",
    "AuthorityEvent",
    "AuthorityRenewal",
    "AuthorityRequest",
    "AuthorityState",
    "Box",
    "CameraImage",
    "Condition",
    "Controller",
    "Count",
    "Cut",
    "Duration",
    "EmergencyStop",
    "EpisodeResult",
    "ExecutionState",
    "Figure",
    "Fraction",
    "Heartbeat",
    "Joints",
    "Light",
    "MasterState",
    "Message",
    "Method",
    "Mode",
    "ModelState",
    "Motion",
    "Name",
    "ObjectPose",
    "OperatorInput",
    "Origin",
    "Outcome",
    "Part",
    "Person",
    "Phase",
    "Pose",
    "Prediction",
    "Purpose",
    "Quaternion",
    "Real",
    "Reason",
    "Recording",
    "RobotState",
    "Role",
    "SafetyState",
    "SceneState",
    "TakeOver",
    "TeachingState",
    "Text",
    "TopicFigures",
    "Trouble",
    "Vector3",
    "Verdict",
    "Way",
    "WorldState",
]
