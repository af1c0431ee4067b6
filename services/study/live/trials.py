"""Runs the parts of people's sessions on the live robot, one at a time."""

from __future__ import annotations

import secrets
from pathlib import Path

from services.process.clock import Clock
from services.process.exceptions import CannotWrite
from services.process.ports import free_port
from services.study.live.setting import Ports, Run, Setting
from services.study.live.stack import Stack
from services.study.live.trial import Begun, Trial
from services.study.page.desk import Desk
from services.study.page.trials import Live
from services.study.personal import recordings_of
from services.study.records import code
from services.study.session.course import Adapt, Train

CLOSE_S = 2.0
"""A network that is left takes no longer."""

_BESIDE = ("", "-wal", "-shm")
"""Of a database's files."""


class LiveTrials:
    """See `services.study.page.trials.Trials`.

    Args:
        folder: of the study.
        station: port of the robot's page, one for all parts: whom the participant's page frames is said beforehand, and
            the browser keeps under it which keys somebody has set.
        setting: of all parts.
        demonstrations: that each model starts from.
        clock: of this process.
    """

    def __init__(self, folder: Path, station: int, setting: Setting, demonstrations: int, clock: Clock) -> None:
        self._folder = folder.resolve()
        self._setting = setting
        self._demonstrations = demonstrations
        self._clock = clock
        self._station = station
        self._seat = secrets.token_hex(12)
        self._desk: Desk | None = None
        self._trial: Trial | None = None

    @property
    def url(self) -> str:
        """Of the station's page, which the participant's shows in a frame.

        In whatever browser it is the same seat; what the browser keeps for it is that participant's.
        """
        person = code(self._trial.live.number) if self._trial is not None else ""
        return f"http://127.0.0.1:{self._station}/#seat={self._seat}&person={person}"

    def attend(self, desk: Desk) -> None:
        """Tell this desk what comes of them."""
        self._desk = desk

    def start(self, number: int, part: Train | Adapt, language: str) -> None:
        """Run a part, from its last checkpoint where it has begun before.

        Args:
            number: of the participant.
            part: that has begun in the journal.
            language: of the participant's page.

        Raises:
            CannotWrite: an old model cannot be taken out of the way.
        """
        assert self._desk is not None, "nobody is told"
        participant = self._desk.conductor.participant(number)
        known = tuple(participant.attempts.get(part.name, ()))
        void = sum(attempt.part == part.name for attempt, _ in participant.void)
        folder = recordings_of(self._folder, number) / part.name.replace("/", "-")
        database = folder / f"model-{void + 1}.sqlite"  # that of a round which does not count is kept
        if not known:
            _remove(database)
        run = Run(part, code(number), language, folder, database)
        ports = Ports(router=free_port(), station=self._station, web=free_port(), stream=free_port())
        begun = Begun(number, part, known, self._demonstrations, self._folder)
        before = self._trial.thread if self._trial is not None else None
        stack = Stack(folder, self._setting.configuration(run, ports))
        self._trial = Trial(self._desk, self._clock, begun, stack, before)
        self._trial.thread.start()

    def stop(self, why: str) -> None:
        """End what runs, if anything does: the robot stands; the part is not over."""
        if self._trial is not None:
            self._trial.stop(why)

    def close(self) -> None:
        """End what runs, and wait until nobody of it is left."""
        if self._trial is not None and self._desk is not None:
            with self._desk.lock:
                self._trial.stop("the study was ended")
            self._trial.thread.join(CLOSE_S)

    def live(self) -> Live | None:
        """What runs now; None where nothing does."""
        return self._trial.live if self._trial is not None and not self._trial.over else None


def _remove(database: Path) -> None:
    try:
        for beside in _BESIDE:
            database.with_name(database.name + beside).unlink(missing_ok=True)
    except OSError as error:
        raise CannotWrite(database, error.strerror or str(error)) from None
