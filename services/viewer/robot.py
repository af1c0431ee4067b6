"""The robot: its shape, what it was told and does, what holds it back."""

from __future__ import annotations

from protocol.messages import ExecutionState, Part, RobotState
from protocol.topics import EXECUTION, ROBOT_STATE, SAFETY_STATE
from services.bus.bus import Bus
from services.bus.stages import stages
from services.viewer import entities, series
from services.viewer.journal import Journal
from services.viewer.kinds import POSES
from services.viewer.news import Changes, News
from services.viewer.robot_model import RobotModel
from services.viewer.run import Run
from services.viewer.words import Words

# What stands still is drawn again this often: a recording's next file does not have it yet.
_REPEAT_S = 1.0


class Robot:
    """Draws the robot's side of a run.

    Args:
        bus: to it.
        run: where it is drawn.
        words: of the run.
        journal: that words are written from.
        model: its shape; None where it has none.
    """

    def __init__(self, bus: Bus, run: Run, words: Words, journal: Journal, model: RobotModel | None) -> None:
        self._run, self._words, self._journal, self._model = run, words, journal, model
        self._states = News(bus.subscribe(ROBOT_STATE))
        self._safety = News(bus.subscribe(SAFETY_STATE))
        self._execution = bus.subscribe(EXECUTION)
        self._changes = Changes(_REPEAT_S)
        self._joint_names: tuple[str, ...] = ()

    @property
    def known(self) -> RobotState | None:
        """Its newest state."""
        return self._states.known

    def draw(self, now_ns: int) -> RobotState | None:
        """Draw what is new; the state where there is a new one."""
        self._draw_safety(now_ns)
        robot = self._states.take(now_ns)
        if robot is None:
            return None
        if robot.joint_names != self._joint_names:
            self._joint_names = robot.joint_names
            series.log_joint_legend(self._run, robot.joint_names)
        if self._changes.due("joints", tuple(round(value, 5) for value in (*robot.q, robot.opening)), now_ns):
            if self._model is not None:
                self._model.move(robot.joint_names, robot.q, robot.opening)
            self._run.row(entities.GRASP, POSES, robot.measured)
        series.log_joints(self._run, robot.q)
        series.log_opening(self._run, robot.opening_reference, robot.opening)
        series.log_following(self._run, robot.reference, robot.measured)
        series.log_correction(self._run, robot.offset, robot.turn)
        series.log_latency(self._run, robot.applied_latency)
        series.log_stages(self._run, stages(robot=robot))
        self._tell(robot, now_ns)
        return robot

    def _tell(self, robot: RobotState, now_ns: int) -> None:
        execution = self._execution.fresh(now_ns) if robot.phase.running else None
        reason = f"{robot.hold_reason}, waits to be asked" if robot.waiting else robot.hold_reason
        self._words.state(entities.PHASE, robot.phase.value, now_ns)
        self._words.state(entities.EPISODE, episode(robot, execution), now_ns)
        self._words.state(entities.HOLD, reason, now_ns)
        self._words.state(entities.CLAMPED, ", ".join(sorted(robot.clamped)), now_ns)
        self._words.write(*self._journal.robot(robot, now_ns))

    def _draw_safety(self, now_ns: int) -> None:
        safety = self._safety.take(now_ns)
        if safety is None:
            return
        series.log_self_distance(self._run, safety.self_distance)
        stop = ""
        if safety.emergency_stop:
            reason = f": {safety.reason}" if safety.reason else ""
            stop = f"{safety.by}{reason}, {'standing' if safety.standing else 'still moving'}"
        self._words.state(entities.STOP, stop, now_ns)
        self._words.write(*self._journal.safety(safety))


def episode(robot: RobotState, execution: ExecutionState | None) -> str:
    """The episode that runs, who shapes it, its pace and the part that is corrected; empty where none runs."""
    if not robot.phase.running:
        return ""
    said = [str(robot.episode), robot.mode.value]
    if execution is not None and execution.pace != 1.0:
        said.append(f"pace {execution.pace:g}")
    if execution is not None and execution.part != Part():
        said.append(f"from {100.0 * execution.part.first:.0f} to {100.0 * execution.part.last:.0f} %")
    return ", ".join(said)
