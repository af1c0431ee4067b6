"""The robot process' shell: hears the operator, answers requests, gives one command a step, reports."""

from __future__ import annotations

import logging
from datetime import UTC, datetime

from protocol import topics
from protocol.messages import Figure
from services.bus.bus import Bus
from services.evidence.ledger import Ledger, Unkept, ledger_file
from services.process.backend import SIMULATED
from services.process.clock import Clock
from services.process.config import Configuration
from services.process.endpoint import parse
from services.process.lines import one_line
from services.process.robots import scene_of
from services.robot.assembly import hardware_arm, kinematics_of, simulated_arm
from services.robot.backends.backend import CONTROL_PERIOD
from services.robot.control import Control
from services.robot.delays import Delays, quantiles
from services.robot.evidence import Evidence, began
from services.robot.foreign import Foreign
from services.robot.memory import Memory, safety_file
from services.robot.requests import Requests
from services.robot.safety import Watchdog
from services.robot.samples import Samples
from services.robot.states import States
from services.robot.synchronisation import Synchronisation
from services.robot.timed_kinematics import TimedKinematics
from services.robot.wire import pose_of
from sim.tasks import described

log = logging.getLogger(__name__)


def build(bus: Bus, clock: Clock, configuration: Configuration, memory: Memory | None = None) -> RobotService:
    """The service on a simulated world, or on hardware.

    Args:
        bus: to hear, answer and report on.
        clock: of the process.
        configuration: of the whole system.
        memory: where stop and epochs outlive the process; by default the robot's file, and then there is the robot's
            evidence log, too.

    Raises:
        SimError: there is no such scene or variant, or the robot's description is not installed.
        StartImpossible: the arm cannot reach the scene's start.
        FolderUnusable: there is no folder for the robot's file.
        UnusableSetting: see `hardware_arm`.
        EnvironmentFault: the hardware's library is not installed, or it does not answer.
    """
    ledger: Ledger = Unkept()
    if memory is None:
        memory, ledger = safety_file(configuration.name), ledger_file(configuration.name)
    section = configuration.robot
    scene = scene_of(section)
    description = described(scene)
    kinematics = TimedKinematics(clock, kinematics_of(scene, description))
    if section.backend.kind == SIMULATED:
        arm = simulated_arm(
            scene,
            section.variant or scene.variants[0],
            description,
            kinematics=kinematics,
            velocity_scale=section.velocity_scale,
            self_distance_stop=section.self_distance_stop,
        )
    else:
        arm = hardware_arm(scene, section, description, kinematics, clock)
    control = Control(
        arm,
        scene,
        lease_s=section.lease_s,
        watchdog=Watchdog(section.hold_after_s, section.presence_after_s),
        master_gain=section.master_gain,
        memory=memory,
        utc=lambda: datetime.now(UTC),
    )
    ledger.add(began(configuration))
    return RobotService(bus, clock, control, kinematics, ledger, proven=parse(configuration.connect).secure)


class RobotService:
    """One arm on the bus.

    Args:
        bus: to hear, answer and report on.
        clock: when a command has been given.
        control: that decides.
        kinematics: whose durations are reported.
        ledger: where everything is written down that somebody may have to answer for.
        proven: the network shows who somebody is.
    """

    rate_hz = 1.0 / CONTROL_PERIOD

    def __init__(
        self,
        bus: Bus,
        clock: Clock,
        control: Control,
        kinematics: TimedKinematics,
        ledger: Ledger,
        *,
        proven: bool = False,
    ) -> None:
        self._bus = bus
        self._clock = clock
        self._control = control
        self._states = States(bus, control)
        self._kinematics = kinematics
        self._synchronisation = Synchronisation(round(CONTROL_PERIOD * 1e9))
        self._samples = Samples(bus)
        self._renewal = bus.subscribe(topics.AUTHORITY_RENEWAL)
        self._request = bus.subscribe(topics.AUTHORITY_REQUEST)
        self._seen = bus.subscribe(topics.OBJECT_POSE)
        self._emergency_stop = bus.subscribe(topics.EMERGENCY_STOP)
        self._ledger = ledger
        self._evidence = Evidence(ledger, control)
        self._requests = Requests(bus, control, self._evidence, proven=proven)
        self._foreign = Foreign()
        self._delays = Delays(self._samples)
        self._given_ns = 0
        self._first_ns: int | None = None
        self._told_epoch = control.lease.epoch
        bus.tell_commander(control.lease.operator)
        self._ticks = self._touching = self._clamped = 0

    def step(self, now_ns: int) -> None:
        """Hear, answer, command, report."""
        self._first_ns = now_ns if self._first_ns is None else self._first_ns
        self._hear()
        self._requests.answer(now_ns)
        sample = self._samples.take(self._covers, self._control.let_go, now_ns)
        if sample is not None:
            self._synchronisation.heard(now_ns, sample.received_ns)
        tick = self._control.tick(now_ns, sample, self._given, self._samples.way_s(sample))
        self._ticks += 1
        self._touching += tick.observation.touch is not None
        self._clamped += bool(tick.clamped)
        self._delays.see(tick, self._control.mode, sample, self._given_ns)
        self._tell_who_commands()
        self._evidence.look()
        self._states.publish(now_ns, tick, self._delays)

    def take_slew_ns(self) -> int:
        """See `Synchronisation`."""
        return self._synchronisation.take_slew_ns()

    def figures(self) -> tuple[Figure, ...]:
        """Since the last call."""
        _, inverse_p99 = quantiles(self._kinematics.steps_ns)
        elapsed = (self._clock.now_ns() - self._first_ns) / 1e9 if self._first_ns is not None else 0.0
        figures = (
            *self._delays.take_figures(),
            Figure("inverse_kinematics_p99", 1e-6 * inverse_p99, "ms"),
            Figure("simulation_lag", max(0.0, elapsed - self._ticks * CONTROL_PERIOD), "s"),
            Figure("touching", float(self._touching), "periods"),
            Figure("clamped", float(self._clamped), "periods"),
            Figure("refused", float(self._requests.refused), "requests"),
            self._foreign.figure(self._clock.now_ns()),
            Figure("late", float(self._samples.late), "samples"),
            Figure("playout", 1e3 * self._samples.delay_s, "ms"),
            Figure("evidence_unwritten", float(self._ledger.unwritten), "events"),
        )
        self._kinematics.steps_ns.clear()
        self._touching = self._clamped = 0
        return figures

    def close(self) -> None:
        """Finish writing what has to outlive the process."""
        self._control.arm.drive.close()
        self._control.memory.close()
        self._ledger.close()

    def _hear(self) -> None:
        for press in self._emergency_stop.take():
            if press.message.pressed:
                self._control.press(press.message.by, press.message.reason)
        for renewal in self._renewal.take():
            said = renewal.message
            if not self._control.lease.renew(said.holder, said.epoch, said.process, renewal.received_ns):
                self._foreign.heard(said.process)
        for request in self._request.take():
            self._control.lease.ask(request.message, request.received_ns)
        for seen in self._seen.take():
            self._control.arm.drive.seen_object = pose_of(seen.message.pose)

    def _covers(self, holder: str, epoch: int, process: str) -> bool:
        """See `Lease.covers`; what it does not cover is counted."""
        covers = self._control.lease.covers(holder, epoch, process)
        if not covers:
            self._foreign.heard(process)
        return covers

    def _tell_who_commands(self) -> None:
        """Tell the network where it has changed, and log who took the authority from whom, and why."""
        lease = self._control.lease
        if self._told_epoch == lease.epoch:
            return
        self._told_epoch = lease.epoch
        self._bus.tell_commander(lease.operator)
        if lease.reason:
            event = lease.event.value.replace("_", " ")
            log.warning("%s", one_line(f"{lease.before}'s authority was {event} by {lease.by}: {lease.reason}"))

    def _given(self) -> None:
        """The arm has its command: what follows in the step, simulated physics included, delays no sample."""
        self._given_ns = self._clock.now_ns()
