"""A study that is served: journal, pages and robot together, until the context ends."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from datetime import UTC, datetime

from services.offline.first_demonstrations import first_demonstrations
from services.process.clock import SystemClock
from services.study.events import Entry
from services.study.live.setting import Setting
from services.study.live.trials import LiveTrials
from services.study.page.desk import Desk
from services.study.page.page import StudyPage
from services.study.personal import Personal
from services.study.readiness import ready
from services.study.session.conductor import Conductor
from services.study.session.markers import Marked
from services.study.study import Study
from services.study.synthetic.rehearsal import Rehearsal

ADDRESS = "127.0.0.1"
"""Of the pages: of this machine alone."""

LAST_PORT = 65_534
"""Of the pages; the robot's has the next one."""


def _utc() -> datetime:
    return datetime.now(UTC)


def _unmarked(entry: Entry) -> None:
    """Nobody listens."""


@contextlib.contextmanager
def served(
    study: Study, port: int, deviation: str, rehearsal: Rehearsal | None, marked: Marked | None
) -> Iterator[StudyPage]:
    """Serve a study; what it has been asked to delete is deleted now, where it was ended before that was done.

    Args:
        study: its folder.
        port: of the pages; the robot's has the next one.
        deviation: why it is no longer as it was frozen; empty where it is.
        rehearsal: who is enrolled; None where people take part.
        marked: is called with every entry of the journal; None where nobody listens.

    Raises:
        ServiceError: it cannot be served.
        SimError: there is no such scene, or no such target in it.
    """
    clock, synthetic = SystemClock(), rehearsal is not None
    instruments, scene, arrangement = ready(study)
    setting = Setting(study.protocol, arrangement, f"http://{ADDRESS}:{port}", synthetic)
    personal = Personal(study.folder)
    with study.journal(_utc, synthetic=synthetic, deviation=deviation, marked=marked or _unmarked) as journal:
        demonstrations = len(first_demonstrations(scene))
        conductor = Conductor(study.protocol, journal, instruments)
        for number, known in conductor.participants().items():
            if known.deleted:
                personal.delete(number)
        if rehearsal is not None:
            rehearsal.enrol(conductor)
        trials = LiveTrials(study.folder, port + 1, setting, demonstrations, clock)
        desk = Desk(conductor, instruments, trials, _utc, personal, synthetic=synthetic)
        trials.attend(desk)
        page = StudyPage(desk, clock, host=ADDRESS, port=port, key=personal.key())
        try:
            page.start()
            yield page
        finally:
            trials.close()
            page.close()
