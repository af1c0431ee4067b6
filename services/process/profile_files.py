"""A person's profiles: TOML files in a folder of their own. What a file does not say stays as it is without one."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec

from services.process.files import make_folder, settings_folder, write_whole
from services.process.profile import Profile
from services.process.written import read

WHAT = "profile"
SUFFIX = ".toml"


@dataclass(frozen=True)
class OwnProfile:
    """A profile as a person wrote it.

    Attributes:
        name: of the file, without its ending.
        profile: what it says; what it does not say means nothing in it.
        said: the same, without what it does not say.
    """

    name: str
    profile: Profile
    said: Mapping[str, Any]

    def over(self, default: Profile) -> Profile:
        """This profile, with what it does not say from another one; each way as a whole, and the buttons as one."""
        below = msgspec.to_builtins(default)
        ways = {**below["ways"], **self.said.get("ways", {})}
        return msgspec.convert({**below, **self.said, "ways": ways}, Profile)


def profiles_folder() -> Path:
    """Where they belong: `devices` in the folder of what a person has set.

    Raises:
        FolderUnusable: it cannot be made or written.
    """
    return settings_folder() / "devices"


def load_profiles(named: str = "") -> tuple[OwnProfile, ...]:
    """All profiles of the person, or the one that is named, alone.

    Raises:
        ConfigurationError: one of them cannot be used, or there is none of the name.
        FolderUnusable: the folder of what a person has set cannot be made or written.
    """
    folder = profiles_folder()
    paths = [folder / f"{named}{SUFFIX}"] if named else sorted(folder.glob(f"*{SUFFIX}"))
    return tuple(load_profile(path) for path in paths)


def load_profile(path: Path) -> OwnProfile:
    """One profile.

    Raises:
        ConfigurationError: it cannot be used; says why.
    """
    profile = read(path, Profile, WHAT)
    said = msgspec.toml.decode(path.read_text(encoding="utf-8"))
    return OwnProfile(path.stem, profile, said)


def save_profile(path: Path, said: Mapping[str, Any], about: Sequence[str]) -> None:
    """Write a profile as `load_profile` reads it.

    Args:
        path: of the file; its folder is made where it is not there.
        said: by key, as in a file.
        about: lines for people, to stand before all.

    Raises:
        OSError: it cannot be written.
    """
    make_folder(path.parent)
    lines = [*(f"# {line}" for line in about), *_toml(said)]
    write_whole(path, ("\n".join(lines) + "\n").encode())


def _toml(table: Mapping[str, Any], place: str = "") -> list[str]:
    """The lines of a table and of those in it."""
    values = {key: value for key, value in table.items() if not isinstance(value, Mapping) and value is not None}
    lines = [f"{key} = {json.dumps(value)}" for key, value in values.items()]
    if place and lines:
        lines = ["", f"[{place}]", *lines]
    for key, value in table.items():
        if isinstance(value, Mapping):
            lines += _toml(value, f"{place}.{key}".removeprefix("."))
    return lines
