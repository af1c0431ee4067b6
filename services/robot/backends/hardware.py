"""The backend on a real arm: the contract around what its maker's driver does."""

import importlib
import logging
import pkgutil

import numpy as np
from numpy.typing import NDArray

from lfd.motion.rotations import exp_map, rotate
from services.process.clock import Clock
from services.process.exceptions import UnusableSetting
from services.robot.backends import vendors
from services.robot.backends.backend import NativeLimits, NotReady, Observation, State, Status, check_first
from services.robot.backends.driver import Driver, Reading, reached
from services.robot.backends.gate import Gate
from sim.robots.robot import Manipulator

Array = NDArray[np.float64]

log = logging.getLogger(__name__)

LOST_S = 0.2  # [s] of the same reading again and again, after which the arm is not heard any more
UP = np.array([0.0, 0.0, 1.0])


def driver_of(kind: str) -> Driver:
    """The driver of a maker's arms.

    Args:
        kind: the name of its file.

    Raises:
        UnusableSetting: there is none.
    """
    known = sorted(module.name for module in pkgutil.iter_modules(vendors.__path__))
    if kind not in known:
        raise UnusableSetting("[robot.backend] kind", f"{kind!r} is none of simulated, {', '.join(known)}")
    found: Driver = importlib.import_module(f"{vendors.__name__}.{kind}").Driver()
    return found


class Hardware:
    """See `Backend`. A software stop is no safety-rated one: the robot's own button is.

    Args:
        driver: of the arm.
        host: where it is reached.
        manipulator: which robot it is: its joints' names.
        variant: of the scene that stands around it.
        yaw: of the arm's first link in the base frame [rad].
        clock: by which it is judged whether the arm is heard.

    Raises:
        UnusableSetting: the robot has another number of joints.
    """

    def __init__(
        self, driver: Driver, host: str, manipulator: Manipulator, *, variant: str, yaw: float, clock: Clock
    ) -> None:
        if len(manipulator.joint_names) != driver.joints:
            found = (
                f"{manipulator.kind} has {len(manipulator.joint_names)} joints, a {driver.maker} arm {driver.joints}"
            )
            raise UnusableSetting("[robot] model", f"{found}: choose another by --robot-model")
        self._driver = driver
        self._host = host
        self._joint_names = manipulator.joint_names
        self._turn = exp_map(yaw * UP)
        self._variant = variant
        self._clock = clock
        self._gate = Gate(self._joint_names, lambda: self._read().q)
        self._reading: Reading | None = None
        self._read_s = self._new_s = self._reset_s = 0.0
        self._same_s: float | None = None
        self._lost = ""
        self._moving = False

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Of the robot, in the maker's order."""
        return self._joint_names

    @property
    def limits(self) -> NativeLimits:
        """See `Backend.limits`."""
        return self._driver.limits

    @property
    def variant(self) -> str:
        """Of the scene, as people set it up."""
        return self._variant

    def connect(self) -> None:
        """See `Backend.connect`."""
        reached(self._driver.maker, self._host, lambda: self._driver.connect(self._host))
        self._lost, self._reading = "", None
        self._gate.connect()
        self._new_s = self._reset_s = self._now
        self._read()
        log.info("connected to a %s arm at %s", self._driver.maker, self._host)

    def close(self) -> None:
        """See `Backend.close`."""
        if self._reading is not None and not self._lost:
            self._stand()
            self._driver.close()
        self._reading = None
        self._gate.close()

    def status(self) -> Status:
        """See `Backend.status`."""
        told = self._gate.status(self._now)
        if told.state is State.NOT_CONNECTED:
            return told
        try:
            reading = self._read()
        except NotReady as error:
            return error.status
        age = self._now - self._new_s
        if reading.state is not State.READY:
            return Status(reading.state, age, reading.reason)
        return Status(told.state, age, told.reason)

    def hold(self) -> None:
        """See `Backend.hold`."""
        self._stand()
        self._gate.hold()

    def stop(self, reason: str) -> None:
        """See `Backend.stop`."""
        self._gate.stop(reason)
        self._stand()

    def recover(self) -> None:
        """See `Backend.recover`; an arm that was lost is reached anew."""
        if self._lost:
            try:
                reached(self._driver.maker, self._host, lambda: self._driver.connect(self._host), within_s=1.0)
            except Exception as error:
                raise NotReady(Status(State.NOT_CONNECTED, self._now - self._new_s, str(error))) from error
            self._lost, self._new_s, self._same_s = "", self._now, None
        self._driver.recover()
        self._reading = None
        reading = self._read()
        if reading.state is not State.READY:
            raise NotReady(Status(reading.state, 0.0, reading.reason))
        self._gate.recover()

    def reset(self, place: Array, variant: str, q: Array) -> None:
        """See `Backend.reset`: people put things in their places, and the arm was led to q before.

        Raises:
            Jump: it was not.
        """
        del place
        check_first(self._joint_names, q, self._read().q)
        self._variant = variant
        self._reset_s = self._now
        self.hold()

    def command(self, q: Array, qd: Array, opening: float) -> None:
        """See `Backend.command`."""
        status = self.status()
        if not status.works:
            raise NotReady(status)
        self._gate.admit(q, self._now)
        self._driver.follow(q, qd, self._read().q)
        self._driver.grip(opening)
        self._moving = True

    def elapse(self) -> None:
        """It does by itself."""

    def observe(self) -> Observation:
        """See `Backend.observe`; what stands around the arm, hardware does not know."""
        if self._moving and self._gate.silent(self._now):
            self._stand()
        reading = self._read()
        return Observation(
            time=self._now - self._reset_s,
            q=reading.q,
            qd=reading.qd,
            object_pose=None,
            touch=None,
            world=np.zeros(0),
            contact_force=rotate(self._turn, reading.force),
            opening=reading.opening,
            grasped=reading.grasped,
        )

    @property
    def _now(self) -> float:
        return self._clock.now_ns() / 1e9

    def _stand(self) -> None:
        if self._moving and not self._lost:
            self._driver.stand()
        self._moving = False

    def _read(self) -> Reading:
        """What the arm says now, asked for once a millisecond at most.

        Raises:
            NotReady: it is not heard.
        """
        now = self._now
        before = self._reading
        if before is not None and not self._lost and now - self._read_s < 1e-3:
            return before
        if not self._lost:
            try:
                reading = self._driver.read()
            except Exception as error:  # noqa: BLE001 (whatever a maker's library raises: the arm is not heard)
                self._lost = " ".join(str(error).split()) or type(error).__name__
            else:
                self._reading, self._read_s = reading, now
                if before is None or reading.stamp != before.stamp:
                    self._new_s, self._same_s = now, None
                else:
                    self._same_s = now if self._same_s is None else self._same_s
                if self._same_s is not None and now - self._same_s > LOST_S:
                    self._lost = f"it was not heard for more than {LOST_S * 1e3:.0f} ms"
                if not self._lost:
                    return reading
        raise NotReady(Status(State.NOT_CONNECTED, now - self._new_s, self._lost))
