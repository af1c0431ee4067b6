"""What happened in one control period."""

from dataclasses import dataclass

from protocol.messages import Phase
from services.robot.backends.backend import Observation
from services.robot.correction import Correction
from services.robot.episode import Episode, EpisodeOutcome
from services.robot.verdict import Verdict
from sim.pose import Pose


@dataclass(frozen=True, eq=False)
class Tick:
    """What happened in one control period.

    Attributes:
        observation: at its end.
        measured: pose of the grasping frame, from the measured joints.
        reference: pose that the joints were to reach.
        opening_reference: that the gripper was to go to [m].
        phase: what the arm did.
        progress: of the episode, from 0 to 1.
        correction: as it was applied.
        hold_reason: why the arm held, empty where it did not.
        clamped: what was clamped.
        self_distance: between parts of the robot, where they are nearest [m].
        verdict: now.
        outcome: of the episode that ended in this period.
        fault: what is wrong with the arm, so that nothing is known of this period; empty where nothing is.
    """

    observation: Observation
    measured: Pose
    reference: Pose
    opening_reference: float
    phase: Phase
    progress: float
    correction: Correction
    hold_reason: str
    clamped: tuple[str, ...]
    self_distance: float
    verdict: Verdict
    outcome: EpisodeOutcome | None
    fault: str


def phase_of(episode: Episode | None, *, holding: bool) -> Phase:
    """What the arm does in an episode, or without one."""
    if episode is None:
        return Phase.IDLE
    if holding:
        return Phase.HOLD
    return Phase.RAMP if episode.execution.ramping else Phase.EXECUTE
