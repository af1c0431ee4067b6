"""A hand at the page's devices, as a master that they lead is told of it in each step."""

from protocol.messages import Controller, Mode, OperatorInput, Phase, Pose, RobotState
from services.master.devices.controllers import Controllers
from services.master.devices.device import Moment
from services.master.devices.keys import Keys
from services.master.devices.led import LedMaster
from services.master.devices.pointer import Pad
from services.master.devices.profiles import Profiles
from services.process.master_devices import Page

LAW = Page(growth=0.12, decay=0.05, reach=0.25, turn_growth=0.4, turn_decay=0.2, turn_reach=0.8)
POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
REFINING = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, mode=Mode.REFINE, episode=1)
REST = (0.0, 0.0, 0.0, 0.0)
UP = (0.0, 0.0, 0.0, -1.0)


def master():
    """As by default: whatever the page reads."""
    profiles = Profiles()
    return LedMaster(
        LAW, (Keys(), Controllers("gamepad", profiles), Controllers("spacemouse", profiles), Pad(profiles))
    )


def pad(axes=REST, number=0, **pressed):
    buttons = [0.0] * 17
    for name, value in pressed.items():
        buttons[int(name.removeprefix("b"))] = value
    return Controller("gamepad", number, "Some pad", True, axes, tuple(buttons))


def pointer(*axes, down=True):
    return Controller("pointer", axes=tuple(axes) + (0.0,) * (6 - len(axes)), buttons=(float(down),))


def moment(*keys, dt=0.01, focused=True, late=False, robot=REFINING, commands=True, pads=(), yaw=0.0):
    held = OperatorInput(keys=keys, focused=focused, late=late, controllers=tuple(pads), yaw=yaw)
    return Moment(0, dt, held, robot, commands)


def hold(master, seconds, *keys, **others):
    sample = None
    for _ in range(round(seconds / 0.01)):
        sample = master.step(moment(*keys, **others))
    return sample


def seated(*pads):
    """A master whose operator sits there and holds nothing yet."""
    one = master()
    for _ in range(2):
        one.step(moment(pads=pads))
    return one
