"""The master process: publishes the state of its device a hundred times a second, in its operator's name.

It belongs to one person's station: under an epoch that the robot does not confirm for that station nobody is at the
device, whatever is held there.

Lost input (focus, tab, link, authority) is told at once: the device disengages, and where it stands means nothing. A
lost process is silent, and so is one that has not taken over yet: the robot holds the correction where it stands.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence

from protocol.messages import Figure, MasterState, Trouble
from protocol.topics import MASTER_STATE, ROBOT_STATE
from services.bus.bus import Bus
from services.master.capture import Capture
from services.master.devices.controllers import Controllers
from services.master.devices.device import Device, Episode, Moment, Sample
from services.master.devices.hand import Source
from services.master.devices.keys import Keys
from services.master.devices.led import LedMaster
from services.master.devices.pointer import Pad
from services.master.devices.profiles import Profiles
from services.master.seat import Seat, Sitting
from services.process.clock import Clock
from services.process.config import Configuration
from services.process.master_devices import Gamepad, Keyboard, Led, Page, Phantom, Pointer, Scripted, SpaceMouse
from services.process.processes import process
from services.process.profile_files import load_profiles

_LONGEST_STEP_S = 0.1
"""A process that was stopped for longer does not make up for it: nobody held a key meanwhile."""

_LISTEN_NS = 300_000_000
"""A process that has just come up listens before it speaks: by saying that nobody is at the device it would let a robot
that holds a correction drop it."""


def build(bus: Bus, clock: Clock, configuration: Configuration) -> MasterService:
    """The service with the device that the configuration names.

    Raises:
        ConfigurationError: a profile of the person cannot be used.
        RoomMissing: the vendor's package for the device is not installed.
        DeviceMissing: the device is not there.
    """
    station = process("station").named(configuration.operator)
    return MasterService(bus, _device(bus, clock, configuration), Seat(bus, station))


def _device(bus: Bus, clock: Clock, configuration: Configuration) -> Device:
    match configuration.master.device:
        case Scripted() as settings:
            # Imported here, so that whoever sits at a page needs no simulation packages.
            from services.master.devices.scripted import ScriptedMaster  # noqa: PLC0415

            return ScriptedMaster(bus, clock, settings, configuration.seed, configuration.robot)
        case Phantom() as settings:
            # Imported here, as the vendor's modules are: nobody else has them.
            from services.master.devices import phantom, stylus  # noqa: PLC0415

            device = phantom.PhantomStylus(phantom.vendor())
            return stylus.StylusMaster(device, settings, Profiles(load_profiles(settings.profile)), clock)
        case led:
            return LedMaster(led, _sources(led))


def _sources(led: Led) -> Sequence[Source]:
    """Whose hands count, of all that the page reads."""
    profiles = Profiles(load_profiles(led.profile))
    match led:
        case Keyboard():
            return (Keys(),)
        case Gamepad():
            return (Controllers("gamepad", profiles),)
        case Pointer():
            return (Pad(profiles),)
        case SpaceMouse():
            from services.master.devices import spacemouse  # noqa: PLC0415  # as above

            mouse = spacemouse.SpaceMouse(spacemouse.vendor(), profiles)
            mouse.start()
            return (mouse,)
        case Page():
            controllers = (Controllers(kind, profiles) for kind in ("gamepad", "spacemouse"))
            return (Keys(), *controllers, Pad(profiles))


class MasterService:
    """The thin shell around a device.

    Args:
        bus: the way to the others.
        device: what the hand is on.
        seat: where its operator sits.
    """

    rate_hz = MASTER_STATE.rate_hz

    def __init__(self, bus: Bus, device: Device, seat: Seat) -> None:
        self._bus = bus
        self._device = device
        self._seat = seat
        self._robot = bus.subscribe(ROBOT_STATE)
        self._capture = Capture(bus.identity)
        self._keys: tuple[str, ...] = ()
        self._started_ns: int | None = None
        self._stepped_ns: int
        self._opening: float | None = None
        self._episode: Episode | None = None

    @property
    def call(self) -> threading.Event:
        """Set where the page was heard."""
        return self._seat.call

    def step_early(self, now_ns: int) -> None:
        """A key that is pressed or let go does not wait for the next tick."""
        if self._seat.look(now_ns).keys != self._keys:
            self.step(now_ns)

    def step(self, now_ns: int) -> None:
        """Bring the device up to now and say where it is, or keep silent, which makes a refining robot hold."""
        sitting = self._seat.look(now_ns)
        self._keys = sitting.keys
        if self._started_ns is None:
            self._started_ns = self._stepped_ns = now_ns
        moment = Moment(
            now_ns=now_ns,
            dt=min((now_ns - self._stepped_ns) / 1e9, _LONGEST_STEP_S),
            operator=sitting.operator,
            robot=self._robot.fresh(now_ns),
            commands=sitting.commands,
        )
        self._stepped_ns = now_ns
        self._capture.sampled(sitting.operator, now_ns)
        sample = self._device.step(moment)
        self._hear_opening(sample, moment)
        if sample is None or moment.robot is None or now_ns - self._started_ns < _LISTEN_NS:
            return
        self._bus.publish(MASTER_STATE, self._state(sample, sitting, now_ns))

    def figures(self) -> tuple[Figure, ...]:
        """What the device measures, and how long it takes until a sample follows what is done at the page."""
        return (*self._device.figures(), *self._capture.take_figures())

    def close(self) -> None:
        """Let go of the device."""
        self._device.close()

    def _hear_opening(self, sample: Sample | None, moment: Moment) -> None:
        """What was asked of the gripper stays so as long as whoever asked is not heard: it may hold something."""
        robot = moment.robot
        if robot is None:
            return
        before, self._episode = self._episode, (robot.publisher, robot.episode)
        if before != self._episode or not robot.phase.running:
            self._opening = None
        if robot.phase.running and moment.commands and moment.operator is not None:
            by_hand = sample.opening if sample is not None else None
            self._opening = by_hand if by_hand is not None else moment.operator.opening

    def _state(self, sample: Sample, sitting: Sitting, now_ns: int) -> MasterState:
        operator = sitting.operator if sitting.commands else None
        blind = operator is not None and operator.blind
        heard = self._robot.latest()
        return MasterState(
            displacement=sample.displacement,
            velocity=sample.velocity,
            rotation=sample.rotation,
            force=sample.force,
            engaged=sample.engaged and sitting.commands and not blind,
            operator=operator.operator if operator is not None else "",
            holder=operator.holder if operator is not None else "",
            epoch=operator.epoch if operator is not None else 0,
            device=self._device.name,
            actions=sample.actions if operator is not None else (),
            trouble=Trouble.BLIND if blind else sample.trouble,
            trouble_with=sample.trouble_with,
            echoed_ns=heard.message.stamp_ns if heard is not None else 0,
            echo_held_ns=max(0, now_ns - heard.received_ns) if heard is not None else 0,
            yaw=sample.yaw,
            contact_energy=sample.contact_energy,
            capture=self._capture.newest_s,
            opening=self._opening,
        )
