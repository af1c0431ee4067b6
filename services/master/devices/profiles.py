"""Which profile a device is read by."""

from __future__ import annotations

from collections.abc import Iterable

from protocol.messages import Controller
from services.process import default_profiles
from services.process.profile import Profile
from services.process.profile_files import OwnProfile

REMEMBERED = 64
"""Devices whose profiles are not looked for again; a stranger may invent more names."""


class Profiles:
    """A person's own profiles before those that need no file.

    Args:
        own: a person's; of several that fit a device the one counts that names it most closely.
    """

    def __init__(self, own: Iterable[OwnProfile] = ()) -> None:
        self._own = sorted(own, key=lambda one: len(one.profile.device), reverse=True)
        self._known: dict[tuple[str, str, bool], Profile] = {}

    def of(self, controller: Controller) -> Profile:
        """The profile of a device."""
        device = (controller.kind, controller.name, controller.standard)
        if device not in self._known:
            if len(self._known) >= REMEMBERED:
                self._known.clear()
            self._known[device] = self._found(controller)
        return self._known[device]

    def _found(self, controller: Controller) -> Profile:
        default = _default(controller)
        for one in self._own:
            if one.profile.kind == controller.kind and one.profile.device.lower() in controller.name.lower():
                return one.over(default)
        return default


def _default(controller: Controller) -> Profile:
    match controller.kind:
        case "spacemouse":
            return default_profiles.SPACE_MOUSE
        case "pointer":
            return default_profiles.POINTER
        case "phantom":
            return default_profiles.PHANTOM
        case _ if controller.standard:
            return default_profiles.STANDARD_GAMEPAD
        case _:
            return default_profiles.OTHER_GAMEPAD
