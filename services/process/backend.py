"""What a configuration says of what moves the robot: `[robot.backend]`."""

from __future__ import annotations

from services.process.section import Section

SIMULATED = "simulated"


class BackendSection(Section, frozen=True):
    """What moves the robot.

    Attributes:
        kind: "simulated", or whose hardware: the name of a file in `services/robot/backends/vendors`.
        host: name or address at which hardware is reached.
    """

    kind: str = SIMULATED
    host: str = ""
