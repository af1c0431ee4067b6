"""What is asked of the model process when an operator has shown a motion: make it one that can be executed."""

from __future__ import annotations

from typing import Annotated

import msgspec

from protocol.messages import MOST_WAYPOINTS, Duration, Motion, Name, Origin, Vector3, Waypoint


class Plan(msgspec.Struct, frozen=True):
    """Make and announce a motion that an operator showed, so that it can be seen and executed like a prediction.

    Attributes:
        origin: how it was shown: through waypoints, which are given then, or as the motion that is given else.
        object_position: that it leads to, base frame [m].
        scene: in which it was shown.
        duration: of the motion [s].
        start: pose of the grasping frame from where it leads to its first waypoint, with the gripper's opening there;
            None to begin at the first waypoint.
        waypoints: poses of the grasping frame, at least three; all with an opening of the gripper, or none. It changes
            at once where a waypoint is reached, and the motion stands there meanwhile.
        motion: as it was shown, in the base frame.
    """

    origin: Origin
    object_position: Vector3
    scene: Name
    duration: Duration
    start: Waypoint | None = None
    waypoints: Annotated[tuple[Waypoint, ...], msgspec.Meta(max_length=MOST_WAYPOINTS)] = ()
    motion: Motion | None = None
