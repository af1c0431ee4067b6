"""What is kept of participants beside the journal: who they are, where somebody has written it down, and recordings.

Names lie in a file of their own, which only its owner reads and which no export has; it and the journal have nothing in
common but the number.
"""

from __future__ import annotations

import csv
import io
import secrets
import shutil
from pathlib import Path

from services.process.exceptions import CannotWrite
from services.process.files import make_folder, write_whole
from services.study.records import code

IDENTITIES, NAMES, KEY = "identities", "names.csv", "console.key"
RECORDINGS = "recordings"

_COLUMNS = ("participant", "name")
_PRIVATE_FOLDER, _PRIVATE = 0o700, 0o600


def recordings_of(study: Path, number: int) -> Path:
    """Folder of a participant's recordings.

    Args:
        study: folder of the study.
        number: of the participant.
    """
    return study / RECORDINGS / code(number)


class Personal:
    """Of one study.

    Args:
        study: its folder.
    """

    def __init__(self, study: Path) -> None:
        self._study = study
        self._folder = study / IDENTITIES

    def names(self) -> dict[int, str]:
        """Those that are written down, by number.

        Raises:
            CannotWrite: the file is none that was written here.
        """
        path = self._folder / NAMES
        if not path.exists():
            return {}
        try:
            with path.open(encoding="utf-8", newline="") as file:
                return {int(row["participant"]): row["name"] for row in csv.DictReader(file)}
        except (OSError, ValueError, KeyError) as error:
            raise CannotWrite(path, f"it cannot be read: {error}") from None

    def name(self, number: int, name: str) -> None:
        """Write down who somebody is.

        Raises:
            CannotWrite: it is not written.
        """
        self._write({**self.names(), number: name})

    def delete(self, number: int) -> None:
        """Delete a participant's name and recordings; what is not there is no fault.

        Raises:
            CannotWrite: something of it is still there.
        """
        names = self.names()
        if names.pop(number, None) is not None:
            self._write(names)
        recordings = recordings_of(self._study, number)
        try:
            if recordings.exists():
                shutil.rmtree(recordings)
        except OSError as error:
            raise CannotWrite(recordings, error.strerror or str(error)) from None

    def key(self) -> str:
        """That the console's address carries, the same in each run: a console that was open goes on.

        Raises:
            CannotWrite: there is no place for it.
        """
        path = self._folder / KEY
        try:
            if not path.exists():
                make_folder(self._folder, _PRIVATE_FOLDER)
                write_whole(path, secrets.token_urlsafe(9).encode(), _PRIVATE)
            return path.read_text(encoding="ascii").strip()
        except OSError as error:
            raise CannotWrite(path, error.strerror or str(error)) from None

    def _write(self, names: dict[int, str]) -> None:
        path = self._folder / NAMES
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerows([_COLUMNS, *sorted(names.items())])
        try:
            make_folder(self._folder, _PRIVATE_FOLDER)
            write_whole(path, text.getvalue().encode(), _PRIVATE)
        except OSError as error:
            raise CannotWrite(path, error.strerror or str(error)) from None
