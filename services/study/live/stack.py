"""The processes of one part: `retouch up`, started and ended with it."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

from services.process.config import Configuration, save
from services.process.exceptions import CannotWrite
from services.process.files import make_folder
from services.process.isolation import retouch_command

STOP_S = 4.0
"""It ends its processes within two seconds, and then the router; later it is killed, and they end with it."""

CONFIGURATION, ERRORS, STATE = "configuration.json", "errors.txt", "state"


class Stack:
    """Of one part; it dies with the thread that has started it, and with this process.

    Args:
        folder: of the part, absolute: configuration, recording, what the robot writes down.
        configuration: of all processes.
    """

    def __init__(self, folder: Path, configuration: Configuration) -> None:
        self.configuration = configuration
        self._folder = folder
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Start it.

        Raises:
            CannotWrite: its folder cannot be written.
        """
        path = self._folder / CONFIGURATION
        try:
            make_folder(self._folder)
            save(self.configuration, path)
            errors = (self._folder / ERRORS).open("wb")
        except OSError as error:
            raise CannotWrite(path, error.strerror or str(error)) from None
        command = ("--supervised", str(os.getpid()), "up", "--no-browser", "--config", str(path))
        with errors:
            self._process = subprocess.Popen(
                retouch_command(command),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=errors,
                # A latched stop and the epochs are of this part alone, and are deleted with it.
                env={**os.environ, "XDG_STATE_HOME": str(self._folder / STATE)},
                process_group=0,  # Ctrl-C is for this process, which ends that one in order
            )

    @property
    def why_ended(self) -> str | None:
        """Why it has ended, for people; None while it runs."""
        if self._process is None or self._process.poll() is None:
            return None
        said = (self._folder / ERRORS).read_text(encoding="utf-8", errors="replace").strip().rpartition("\n")[2]
        code = self._process.returncode
        how = f"killed by signal {-code}" if code < 0 else f"ended with code {code}"
        return said.removeprefix("retouch: ") or how

    def stop(self) -> None:
        """End it, and wait for its end."""
        if self._process is None or self._process.poll() is not None:
            return
        self._process.terminate()
        try:
            self._process.wait(STOP_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
