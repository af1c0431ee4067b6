"""Which profile a device is read by."""

from __future__ import annotations

from collections.abc import Iterable

from protocol.messages import Controller
from services.process import default_profiles
from services.process.profile import Profile


class Profiles:
    """A person's own profiles before those that need no file.

    Args:
        own: a person's; of several that fit a device the one counts that names it most closely.
    """

    def __init__(self, own: Iterable[Profile] = ()) -> None:
        self._own = sorted(own, key=lambda profile: len(profile.device), reverse=True)

    def of(self, controller: Controller) -> Profile:
        """The profile of a device."""
        for profile in self._own:
            if profile.kind == controller.kind and profile.device.lower() in controller.name.lower():
                return profile
        return _default(controller)


def _default(controller: Controller) -> Profile:
    match controller.kind:
        case "spacemouse":
            return default_profiles.SPACE_MOUSE
        case "pointer":
            return default_profiles.POINTER
        case _ if controller.standard:
            return default_profiles.STANDARD_GAMEPAD
        case _:
            return default_profiles.OTHER_GAMEPAD
