"""A hand on a Phantom, whose vendor's interface is stood in for, and the process that owns it."""

import msgspec
import numpy as np

from protocol.messages import Mode, OperatorInput, Phase, Pose, RobotState
from services.master.devices.device import Moment
from services.master.devices.phantom import TO_BASE, PhantomStylus
from services.master.devices.profiles import Profiles
from services.master.devices.stylus import StylusMaster
from services.process.clock import ManualClock
from services.process.master_devices import Phantom

POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
REFINING = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, mode=Mode.REFINE, episode=1)
LED = msgspec.structs.replace(REFINING, mode=Mode.TEACH)
MS = 1_000_000


class FakeDriver:
    """The vendor's interface: its scheduler is called by hand."""

    def __init__(self, *, there=True):
        self.there = there
        self.place = np.zeros(3)  # [mm], in the device's axes
        self.turned = np.eye(3)
        self.buttons = 0
        self.force = None
        self.body = None
        self.enabled = False
        self.stopped = None

    def init_device(self):
        return 7 if self.there else None

    def enable_force(self):
        self.enabled = True

    def serve(self, body):
        self.body = body

    def get_transform(self):
        return [*[[*column, 0.0] for column in self.turned.T.tolist()], [*self.place.tolist(), 1.0]]

    def get_buttons(self):
        return self.buttons

    def set_force(self, force):
        self.force = tuple(force)

    def stop(self, device):
        self.stopped = device


class Desk:
    """A hand on the stylus, and the process that owns it."""

    def __init__(self, **settings):
        self.driver = FakeDriver()
        self.clock = ManualClock()
        self.master = StylusMaster(PhantomStylus(self.driver), Phantom(**settings), Profiles(), self.clock)

    def run(self, seconds, robot=REFINING, *, present=True, held=True, focused=True, yaw=0.0):
        """The force loop a thousand times a second, the process a hundred times."""
        self.driver.buttons = int(held)
        sample = None
        for k in range(round(seconds * 1e3)):
            self.clock.advance(1e-3)
            self.driver.body()
            if k % 10 == 9:
                operator = OperatorInput(present=present, focused=focused, yaw=yaw)
                sample = self.master.step(Moment(self.clock.now_ns(), 0.01, operator, robot, commands=True))
        return sample

    def move(self, x, y, z):
        """Of the hand, in base axes [m]."""
        self.driver.place = self.driver.place + 1e3 * np.linalg.inv(TO_BASE) @ np.array((x, y, z))
