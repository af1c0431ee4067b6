"""What the robot tells everybody: each topic at the rate that the registry gives it."""

from protocol import messages, topics
from services.bus.arrays import to_wire, vector3
from services.bus.bus import Bus
from services.process.schedule import Schedule
from services.robot import wire
from services.robot.backends.backend import Observation
from services.robot.control import Control
from services.robot.delays import Delays
from services.robot.execution import Execution
from services.robot.order import Finished
from services.robot.safety import standing
from services.robot.tick import Tick
from sim.pose import Pose


class States:
    """Publishes the robot's states.

    Args:
        bus: to publish on.
        control: that is reported.
    """

    def __init__(self, bus: Bus, control: Control) -> None:
        self._bus = bus
        self._control = control
        self._schedule = Schedule()
        self._epoch = -1
        self._stop_latched: bool | None = None
        self._arranged: tuple[str, Pose, bytes] | None = None
        self._finished: Finished | None = None

    def publish(self, now_ns: int, tick: Tick, delays: Delays) -> None:
        """Publish what is due; a change of authority or scene, the emergency stop and a result at once.

        Args:
            now_ns: the time.
            tick: the control period that ended.
            delays: of what the operator does.
        """
        control, due = self._control, self._schedule.due
        self._bus.publish(topics.ROBOT_STATE, self._robot_state(tick, delays))
        if due(topics.WORLD_STATE, now_ns):
            self._publish_world(tick.observation)
        if due(topics.VERDICT, now_ns):
            self._bus.publish(topics.VERDICT, wire.verdict(tick.verdict))
        if due(topics.AUTHORITY_STATE, now_ns) or self._epoch != control.lease.epoch:
            self._epoch = control.lease.epoch
            self._bus.publish(topics.AUTHORITY_STATE, self._authority_state(now_ns))
        stop_latched = control.latch.latched and control.memory.settled
        if due(topics.SAFETY_STATE, now_ns) or self._stop_latched != stop_latched:
            self._stop_latched = stop_latched
            self._bus.publish(topics.SAFETY_STATE, self._safety_state(tick, stop_latched=stop_latched))
        arm = control.arm
        arranged = (arm.variant, arm.start, arm.condition.tobytes())
        if due(topics.SCENE_STATE, now_ns) or self._arranged != arranged:
            self._arranged = arranged
            state = wire.scene_state(control.scene, arm.variant, arm.start, arm.condition)
            self._bus.publish(topics.SCENE_STATE, state)
        if due(topics.EXECUTION, now_ns):
            self._publish_execution()
        self._publish_result(now_ns)

    def _publish_world(self, seen: Observation) -> None:
        """What a simulator knows; hardware knows nothing of the world around it."""
        if seen.world.size and seen.object_pose is not None:
            true_pose = wire.pose(seen.object_pose)
            state = messages.WorldState(time=seen.time, qpos=to_wire(seen.world), object_pose=true_pose)
            self._bus.publish(topics.WORLD_STATE, state)

    def _publish_execution(self) -> None:
        order, episode = self._control.order, self._control.arm.episode
        if order is None or episode is None:
            return
        state = messages.ExecutionState(
            episode=order.episode,
            mode=order.mode,
            prediction=order.prediction,
            progress=episode.execution.progress,
        )
        if isinstance(episode.execution, Execution):
            state = wire.with_pace(state, episode.execution)
        self._bus.publish(topics.EXECUTION, state)

    def _publish_result(self, now_ns: int) -> None:
        finished = self._control.finished
        due = self._schedule.due(topics.EPISODE_RESULT, now_ns)
        if finished is not None and (due or finished is not self._finished):
            self._bus.publish(topics.EPISODE_RESULT, wire.episode_result(finished))
        self._finished = finished

    def _robot_state(self, tick: Tick, delays: Delays) -> messages.RobotState:
        order = self._control.order
        return messages.RobotState(
            joint_names=self._control.arm.joint_names,
            q=tuple(tick.observation.q.tolist()),
            qd=tuple(tick.observation.qd.tolist()),
            measured=wire.pose(tick.measured),
            reference=wire.pose(tick.reference),
            phase=self._control.phase(tick),
            mode=self._control.mode,
            episode=order.episode if order is not None else 0,
            progress=tick.progress,
            offset=vector3(tick.correction.offset),
            master_gain=self._control.master_gain,
            turn=vector3(tick.correction.turn),
            hold_reason=tick.hold_reason,
            waiting=self._control.waiting,
            clamped=tick.clamped[:16],
            contact_force=vector3(self._control.contact.force),
            contact_energy=self._control.contact.energy_in,
            applied_sequence=delays.applied.sequence,
            applied_latency=delays.applied.latency,
            applied_way=delays.applied.way,
            following_lag=delays.following_s,
            ahead=delays.ahead_s,
            opening=tick.observation.opening,
            opening_reference=tick.opening_reference,
            grasped=tick.observation.grasped,
        )

    def _authority_state(self, now_ns: int) -> messages.AuthorityState:
        lease = self._control.lease
        question = lease.asking.question
        return messages.AuthorityState(
            operator=lease.operator,
            holder=lease.holder,
            epoch=lease.epoch,
            expires_in=lease.expires_in_s(now_ns),
            event=lease.event,
            by=lease.by,
            before=lease.before,
            reason=lease.reason,
            asked_by=question.who if question is not None else "",
            asked=question.number if question is not None else 0,
            asked_left=lease.asking.left_s(now_ns),
            kept_from=lease.asking.kept_from,
        )

    def _safety_state(self, tick: Tick, *, stop_latched: bool) -> messages.SafetyState:
        """As it is kept: a stop shows as latched when it would outlive this process, or a line says why not."""
        latch, memory, backend = self._control.latch, self._control.memory, self._control.arm.drive.status()
        return messages.SafetyState(
            emergency_stop=stop_latched,
            by=latch.by,
            reason="; ".join(part for part in (latch.reason, memory.fault) if part),
            at=latch.at,
            released_by=latch.released_by,
            earlier=self._control.latched_earlier,
            standing=standing(tick.observation.qd),
            self_distance=tick.self_distance,
            backend=backend.state.value,
            backend_age=backend.age,
        )
