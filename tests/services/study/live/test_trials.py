"""A part that runs: with which model, and what is written down where its processes end by themselves."""

from typing import ClassVar

import pytest

from services.process.clock import SystemClock
from services.study.arrangement import arrangement
from services.study.events import BrokenOff
from services.study.live import trials as live
from services.study.live.setting import Setting
from services.study.page import acts
from sim.tasks import DISHWASHER
from tests.services.study.page.acting import agree, begin, fill, stage
from tests.study_harness import Served

WITHIN_S = 10.0


class Stack:
    """Stands in for the processes: they have ended before anybody sees them."""

    started: list["Stack"] = []  # noqa: RUF012 - a fixture empties it

    def __init__(self, folder, configuration):
        self.folder, self.configuration = folder, configuration
        self.why_ended = "master: the phantom is not there"

    def start(self):
        self.started.append(self)

    def stop(self):
        pass


@pytest.fixture
def study(tmp_path, monkeypatch):
    """A study whose participant is before the first training, on a robot whose processes end at once."""
    monkeypatch.setattr(live, "Stack", Stack)
    monkeypatch.setattr(Stack, "started", [])
    made = Served(tmp_path / "raw", 0, "http://127.0.0.1:1/")
    protocol = made.desk.conductor.protocol
    setting = Setting(protocol, arrangement(protocol, DISHWASHER), "http://127.0.0.1:8090")
    made.trials = made.desk.trials = live.LiveTrials(tmp_path, 8091, setting, 2, SystemClock())
    made.trials.attend(made.desk)
    made.desk.console_does(acts.Enrol(number=1, language="en"))
    agree(made)
    fill(made)
    yield made
    made.trials.close()
    made.journal.close()


def waits_until_broken(study):
    begin(study)
    study.trials._trial.thread.join(WITHIN_S)


def test_processes_that_end_by_themselves_are_noted_with_why_and_the_part_can_go_on(study):
    waits_until_broken(study)
    (broken,) = [event for event in study.events if isinstance(event, BrokenOff)]
    assert (broken.part, broken.why) == ("OnKey/training", "master: the phantom is not there")
    assert study.trials.live() is None
    assert stage(study).resumed
    waits_until_broken(study)
    assert len(Stack.started) == 2


def test_a_part_has_its_folder_and_one_that_goes_on_the_model_that_it_had(study, tmp_path):
    waits_until_broken(study)
    model = tmp_path / "recordings" / "P01" / "OnKey-training" / "model-1.sqlite"
    assert Stack.started[-1].configuration.model.database == str(model)
    assert Stack.started[-1].folder == model.parent


def test_the_robots_page_speaks_the_language_of_the_press(study):
    for language in ("en", "de"):
        begin(study, language=language)
        study.trials._trial.thread.join(WITHIN_S)
        assert Stack.started[-1].configuration.station.language == language


def test_a_model_of_which_nothing_was_told_begins_anew(study, tmp_path):
    model = tmp_path / "recordings" / "P01" / "OnKey-training" / "model-1.sqlite"
    model.parent.mkdir(parents=True)
    for name in ("model-1.sqlite", "model-1.sqlite-wal"):
        (model.parent / name).write_bytes(b"of another run")
    waits_until_broken(study)
    assert list(model.parent.iterdir()) == []


def test_what_was_stopped_before_it_was_ready_is_neither_over_nor_broken(study):
    with study.desk.lock:
        begin(study)
        study.desk.console_does(acts.Pause(number=1, reason="coffee"))
    study.trials._trial.thread.join(WITHIN_S)
    assert Stack.started == []
    assert study.trials.live() is None
    assert not any(isinstance(event, BrokenOff) for event in study.events)


class Corrected:
    """Stands in for a watch: a motion is being corrected."""

    unfinished: ClassVar = {"acting": 3.5, "holding": 0.0, "alone": 1.0, "other": 2.0}


@pytest.mark.parametrize(
    ("act", "why"),
    [
        (acts.Pause(number=1, reason="coffee"), "interrupted by the experimenter"),
        (acts.Abort(number=1, reason="ill"), "their session was ended by the experimenter"),
        (acts.WithdrawFor(number=1, delete=False), "the participant has withdrawn"),
    ],
)
def test_a_correction_that_somebody_interrupts_is_told_with_its_times(study, act, why):
    with study.desk.lock:
        begin(study)
        study.trials._trial._watch = Corrected()
        study.desk.console_does(act)
    study.trials._trial.thread.join(WITHIN_S)
    (broken,) = [event for event in study.events if isinstance(event, BrokenOff)]
    assert (broken.part, broken.why, broken.raw) == ("OnKey/training", why, Corrected.unfinished)
