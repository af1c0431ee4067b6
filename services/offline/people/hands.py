"""A person's hand at each device of the operator's page."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Generic, TypeVar

import msgspec
import numpy as np
from numpy.typing import NDArray

from protocol.messages import OperatorInput
from services.offline.people import told
from services.offline.people.ways import Device
from services.process import default_profiles
from services.process.master_devices import Page
from services.process.profile import Profile
from sim.person.fingers import Fingers, Handling
from sim.person.helm import Helm, Reach
from sim.person.intention import Intention
from sim.person.itinerary import Itinerary
from sim.person.pen import Dragged, Pad, Pen
from sim.pose import Pose

Array = NDArray[np.float64]

Act = TypeVar("Act")

ATTENDS = OperatorInput(present=True, focused=True)
"""A page in front of somebody who holds nothing."""

PRESSED_S = 0.15
"""A button of a device is held for as long [s]."""

_LAW = Page()
_NOTCH = 0.05
"""Of the pad's wheel, in halves of the pad."""

_ROOM = 1.5
"""So many halves of the pad a hand drags in one go."""

_RATE = np.repeat([_LAW.growth, _LAW.turn_growth], 3)
_DECAY = np.repeat([_LAW.decay, _LAW.turn_decay], 3)
_REACH = np.repeat([_LAW.reach, _LAW.turn_reach], 3)
_KEYS = Handling(_RATE, _DECAY, np.repeat([0.010, 0.12], 3), _REACH, graded=False)
_FULL = np.repeat([0.05, 0.3], 3)
_FINE = np.repeat([0.006, 0.10], 3)


class PersonHand(ABC):
    """One hand, or both, at a device of the page."""

    def __init__(self) -> None:
        self._button: tuple[str, float] | None = None

    @abstractmethod
    def correct(self, helm: Helm, time: float, progress: float, robot: Pose, intention: Intention) -> None:
        """See `Helm.correct`."""

    @abstractmethod
    def lead(self, helm: Helm, time: float, robot: Pose, itinerary: Itinerary) -> bool:
        """See `Helm.lead`; whether the robot stands where it was led to."""

    @abstractmethod
    def rest(self) -> None:
        """Let go."""

    @abstractmethod
    def says(self, time: float) -> OperatorInput:
        """What the page says of it."""

    def press(self, action: str, time: float) -> bool:
        """Press the device's button for an action of the workflow; False where it has none."""
        if action not in self.buttons:
            return False
        self._button = action, time
        return True

    @property
    def buttons(self) -> tuple[str, ...]:
        """Actions that have a button on the device."""
        return ()

    def _pressed(self, time: float) -> str:
        """The action whose button is held now; empty for none."""
        if self._button is None or time - self._button[1] > PRESSED_S:
            return ""
        return self._button[0]


class _Leading(PersonHand, Generic[Act]):
    """On a device that is pushed or dragged.

    Args:
        reach: with which they lead.
    """

    def __init__(self, reach: Reach[Act]) -> None:
        super().__init__()
        self._reach = reach
        self._done = reach.rest()

    def correct(self, helm: Helm, time: float, progress: float, robot: Pose, intention: Intention) -> None:
        """See `PersonHand`."""
        self._done = helm.correct(self._reach, time, progress, robot, intention)

    def lead(self, helm: Helm, time: float, robot: Pose, itinerary: Itinerary) -> bool:
        """See `PersonHand`."""
        self._done, arrived = helm.lead(self._reach, time, robot, itinerary)
        return arrived

    def rest(self) -> None:
        """See `PersonHand`."""
        self._done = self._reach.rest()


class OnKeys(_Leading[Array]):
    """On the keyboard."""

    def __init__(self, rng: np.random.Generator) -> None:
        super().__init__(Fingers(_KEYS, rng))

    def says(self, time: float) -> OperatorInput:
        """See `PersonHand`."""
        del time
        return msgspec.structs.replace(ATTENDS, keys=told.keys(self._done))


class OnController(_Leading[Array]):
    """On a gamepad or a 3-D mouse.

    Args:
        device: which of the two.
        rng: of the hand.
    """

    def __init__(self, device: Device, rng: np.random.Generator) -> None:
        mouse = device is Device.SPACE_MOUSE
        self._profile = default_profiles.SPACE_MOUSE if mouse else default_profiles.STANDARD_GAMEPAD
        self._told = told.space_mouse if mouse else told.gamepad
        super().__init__(Fingers(_handling(self._profile, crosstalk=0.08 if mouse else 0.0), rng))

    @property
    def buttons(self) -> tuple[str, ...]:
        """See `PersonHand`."""
        return ("store", "finish")

    def says(self, time: float) -> OperatorInput:
        """See `PersonHand`."""
        buttons = self._profile.buttons
        held = {"store": buttons.store, "finish": buttons.finish}.get(self._pressed(time))
        controller = self._told(self._done, self._profile, () if held is None else (held,))
        return msgspec.structs.replace(ATTENDS, controllers=(controller,))


class OnPad(_Leading[Dragged]):
    """On the pad of the page, with a mouse that has a wheel."""

    def __init__(self) -> None:
        pad = Pad(_NOTCH * _LAW.reach, _NOTCH * _LAW.turn_reach, _ROOM * _LAW.reach, _ROOM * _LAW.turn_reach)
        super().__init__(Pen(pad))

    def says(self, time: float) -> OperatorInput:
        """See `PersonHand`."""
        del time
        profile = default_profiles.POINTER
        controller = told.pointer(self._done.far / _REACH, profile, down=self._done.down)
        return msgspec.structs.replace(ATTENDS, controllers=(controller,))


class Off(PersonHand):
    """On no device of the page: the stylus is the master's, and so is whoever leads it."""

    def correct(self, helm: Helm, time: float, progress: float, robot: Pose, intention: Intention) -> None:
        """See `PersonHand`."""

    def lead(self, helm: Helm, time: float, robot: Pose, itinerary: Itinerary) -> bool:
        """See `PersonHand`."""
        return False

    def rest(self) -> None:
        """See `PersonHand`."""

    def says(self, time: float) -> OperatorInput:
        """See `PersonHand`."""
        del time
        return ATTENDS


def hand_at(device: Device, rng: np.random.Generator) -> PersonHand:
    """A hand at a device.

    Args:
        device: that it is at.
        rng: of the hand.
    """
    match device:
        case Device.KEYBOARD:
            return OnKeys(rng)
        case Device.GAMEPAD | Device.SPACE_MOUSE:
            return OnController(device, rng)
        case Device.POINTER:
            return OnPad()
        case Device.STYLUS:
            return Off()


def _handling(profile: Profile, crosstalk: float) -> Handling:
    return Handling(_RATE, _DECAY, _FINE, _FULL, graded=True, idle=profile.dead_zone, crosstalk=crosstalk)
