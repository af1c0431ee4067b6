"""A study that is served: journal, pages and robot together, until the context ends."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from datetime import UTC, datetime

from services.offline.first_demonstrations import first_demonstrations
from services.process.clock import SystemClock
from services.study.arrangement import arrangement
from services.study.instruments.library import of_protocol
from services.study.live.setting import Setting
from services.study.live.trials import LiveTrials
from services.study.page.desk import Desk
from services.study.page.page import StudyPage
from services.study.personal import Personal
from services.study.session.conductor import Conductor
from services.study.study import Study
from sim.tasks import scene as scene_named

ADDRESS = "127.0.0.1"
"""Of the pages: of this machine alone."""

LAST_PORT = 65_534
"""Of the pages; the robot's has the next one."""


def _utc() -> datetime:
    return datetime.now(UTC)


@contextlib.contextmanager
def served(study: Study, port: int, deviation: str, synthetic: int, seed: int) -> Iterator[StudyPage]:
    """Serve a study; what it has been asked to delete is deleted now, where it was ended before that was done.

    Args:
        study: its folder.
        port: of the pages; the robot's has the next one.
        deviation: why it is no longer as it was frozen; empty where it is.
        synthetic: so many simulated participants are enrolled, for a rehearsal; 0 where people take part.
        seed: of the simulated ones.

    Raises:
        ServiceError: it cannot be served.
        SimError: there is no such scene, or no such target in it.
    """
    clock, rehearsal = SystemClock(), synthetic > 0
    instruments, scene = of_protocol(study.protocol, study.folder), scene_named(study.protocol.task.scene)
    setting = Setting(study.protocol, arrangement(study.protocol, scene), f"http://{ADDRESS}:{port}", rehearsal)
    personal = Personal(study.folder)
    with study.journal(_utc, synthetic=rehearsal, deviation=deviation) as journal:
        demonstrations = len(first_demonstrations(scene))
        conductor = Conductor(study.protocol, journal, instruments)
        for number, known in conductor.participants().items():
            if known.deleted:
                personal.delete(number)
        for number in range(1, synthetic + 1):
            if number not in conductor.participants():
                conductor.enrol(number, study.protocol.languages[0], synthetic=True, seed=seed + number)
        trials = LiveTrials(study.folder, port + 1, setting, demonstrations, clock)
        desk = Desk(conductor, instruments, trials, _utc, personal, synthetic=rehearsal)
        trials.attend(desk)
        page = StudyPage(desk, clock, host=ADDRESS, port=port, key=personal.key())
        try:
            page.start()
            yield page
        finally:
            trials.close()
            page.close()
