"""Which skill a robot uses for which task, as it lies on disk: a restart goes on with the one that was chosen."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import msgspec

from lfd.store.stored import Binding
from services.model.exceptions import ChoiceLost
from services.process.exceptions import CannotWrite
from services.process.files import write_whole

FILE = "in-use.json"

KNOWN_AGAIN = 64
"""Requests that are known again: so many were made since, at most."""

_LARGEST = 1 << 20


class _Kept(msgspec.Struct, frozen=True):
    """The file.

    Attributes:
        skills: by what they are for.
        requests: that have chosen one, the newest last.
        run: in which the last choice was made; empty where that was none of `retouch up`.
    """

    skills: dict[str, str] = {}
    requests: Annotated[list[int], msgspec.Meta(max_length=KNOWN_AGAIN)] = []
    run: str = ""


class Choice:
    """What was chosen.

    Args:
        folder: of the skills.

    Raises:
        ChoiceLost: the file cannot be read, or holds something else.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / FILE
        self._kept = self._read()

    def of(self, binding: Binding) -> str:
        """The skill that was chosen for a task and a robot; empty where none was."""
        return self._kept.skills.get(str(binding), "")

    def chose(self, binding: Binding) -> bool:
        """Whether any was."""
        return bool(self.of(binding))

    def knows(self, request: int) -> bool:
        """Whether a request has chosen one already."""
        return request in self._kept.requests

    @property
    def run(self) -> str:
        """In which the last choice was made."""
        return self._kept.run

    def make(self, binding: Binding, name: str, request: int = 0, run: str | None = None) -> None:
        """Choose; on disk once this has returned.

        Args:
            binding: what for.
            name: of the skill.
            request: by which it is known again; 0 where it is not asked for twice.
            run: in which it is chosen; None for the one that the last choice was made in.

        Raises:
            CannotWrite: it cannot be written; all is as before.
        """
        requests = [*self._kept.requests, request][-KNOWN_AGAIN:] if request else self._kept.requests
        kept = _Kept({**self._kept.skills, str(binding): name}, requests, self.run if run is None else run)
        if kept == self._kept:
            return
        try:
            write_whole(self._path, msgspec.json.format(msgspec.json.encode(kept)) + b"\n")
        except OSError as error:
            raise CannotWrite(self._path, error.strerror or str(error)) from None
        self._kept = kept

    def _read(self) -> _Kept:
        try:
            with self._path.open("rb") as file:
                return msgspec.json.decode(file.read(_LARGEST), type=_Kept)
        except FileNotFoundError:
            return _Kept()
        except (OSError, msgspec.MsgspecError) as error:
            raise ChoiceLost(self._path, getattr(error, "strerror", None) or str(error)) from None
