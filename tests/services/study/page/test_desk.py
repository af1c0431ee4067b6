"""What a participant does counts once, at its time, and for what was seen; all of it is in the journal."""

from datetime import timedelta

import msgspec
import pytest

from services.study import events
from services.study.exceptions import AnswerRefused, NotNow, ParticipantThere, ParticipantUnknown
from services.study.page import acts
from services.study.page.console import console_view
from services.study.page.participant import Break, Consent, Form, Practice, Ready, Trial, Wait, participant_view
from tests.services.study.page.acting import agree, answers, begin, fill, row, stage
from tests.study_harness import Served


def test_nothing_comes_before_the_consent_to_the_text_that_was_shown(study):
    assert isinstance(stage(study), Consent)
    with pytest.raises(NotNow, match="version 1 of the text was shown, the study has 2"):
        agree(study, version="1")
    with pytest.raises(NotNow):
        study.desk.participant_does(1, acts.Begin(part="OnKey/training", language="en"))
    agree(study)
    assert isinstance(stage(study), Form)
    assert participant_view(study.desk, 1, "v").language == "de"


def test_a_form_that_is_not_complete_is_refused_and_nothing_of_it_is_written_down(study):
    agree(study)
    before = len(study.events)
    with pytest.raises(AnswerRefused, match="gender: there is no answer"):
        fill(study, answers={})
    assert len(study.events) == before
    fill(study)
    assert isinstance(study.events[-1], events.Answered)


def test_a_form_that_is_handed_in_twice_counts_once(study):
    agree(study)
    complete = answers(study)
    fill(study)
    with pytest.raises(NotNow, match="not at participant any more"):
        study.desk.participant_does(1, acts.Fill(part="participant", version="1", language="en", answers=complete))
    assert sum(isinstance(event, events.Answered) for event in study.events) == 1


def test_a_form_of_another_version_is_refused(study):
    agree(study)
    with pytest.raises(NotNow, match="version 0 of participant was shown"):
        fill(study, version="0")


def test_a_form_is_asked_in_the_same_order_however_often_it_is_loaded(study):
    agree(study)
    fill(study)
    study.desk.conductor.end(1, study.desk.conductor.now(1))
    for _ in range(2):
        study.desk.conductor.end(1, study.desk.conductor.now(1))
    assert stage(study).order == stage(study).order
    assert len(stage(study).order) == 21


def test_who_begins_sees_the_robots_page_and_the_console_sees_who_runs(ready):
    assert isinstance(stage(ready), Ready)
    begin(ready)
    practice = Practice(succeeded=0, of_last=4, successes=2, minutes=30)
    assert stage(ready) == Trial(url=ready.trials.url, attempts=0, practice=practice)
    ready.trials.attempt(success=True)
    assert stage(ready) == Trial(
        url=ready.trials.url, attempts=1, practice=msgspec.structs.replace(practice, succeeded=1)
    )
    assert row(ready).state == "runs"
    assert console_view(ready.desk, 1, "v").live.number == 1


def test_the_robots_page_speaks_as_the_participants_did_when_they_pressed_and_so_does_a_fresh_browser(ready):
    begin(ready, language="nl")
    ready.trials.running = None  # the robot's process has died
    begin(ready, language="en")
    part = ready.desk.conductor.now(1).name
    ready.desk.console_does(acts.Pause(number=1))
    ready.desk.console_does(acts.GoOn(number=1, part=part))
    assert [language for *_, language in ready.trials.started] == ["nl", "en", "en"]
    assert participant_view(ready.desk, 1, "v").language == "en"
    with pytest.raises(NotNow, match="the study speaks en, de, nl, not 'fr'"):
        begin(ready, language="fr")


def test_a_fresh_browser_opens_in_the_language_of_the_last_form(study):
    agree(study)
    fill(study, language="nl")
    assert participant_view(study.desk, 1, "v").language == "nl"


def test_a_second_press_starts_nothing_twice(ready):
    begin(ready)
    with pytest.raises(NotNow, match="it runs already"):
        begin(ready)
    assert len(ready.trials.started) == 1


def test_one_trial_runs_at_a_time(ready):
    ready.desk.console_does(acts.Enrol(number=2, language="en"))
    agree(ready, 2)
    fill(ready, 2)
    begin(ready)
    assert stage(ready, 2) == Wait(why="busy")
    with pytest.raises(NotNow, match="one of participant 1 runs already"):
        begin(ready, 2)


def test_a_number_twice_is_one_clear_line(study):
    with pytest.raises(ParticipantThere, match="there is a participant 1 already"):
        study.desk.console_does(acts.Enrol(number=1, language="en"))


def test_a_break_begins_when_it_comes_and_lasts_what_the_protocol_says(resting):
    assert isinstance(stage(resting), Break)
    assert stage(resting).left_s == 300
    with pytest.raises(NotNow, match="the break lasts"):
        resting.desk.participant_does(1, acts.EndBreak(part=resting.desk.conductor.now(1).name))
    resting.later = timedelta(minutes=2)
    assert 175 <= stage(resting).left_s <= 180
    resting.later = timedelta(minutes=6)
    assert stage(resting).left_s == 0
    resting.desk.participant_does(1, acts.EndBreak(part=resting.desk.conductor.now(1).name))
    assert isinstance(stage(resting), Ready)


def test_nobody_unknown_does_anything(study):
    with pytest.raises(ParticipantUnknown):
        agree(study, 7)


def test_another_server_on_the_same_journal_shows_the_same(ready, tmp_path):
    begin(ready)
    ready.trials.attempt(success=True)
    ready.trials.running = None
    shown = participant_view(ready.desk, 1, "v"), console_view(ready.desk, 1, "v").parts
    ready.journal.close()
    again = Served(tmp_path / "raw", 0, "http://127.0.0.1:1/")
    ready.journal = again.journal  # which is closed in its place
    assert (participant_view(again.desk, 1, "v"), console_view(again.desk, 1, "v").parts) == shown


def test_a_whole_session_ends_at_its_end(resting):
    resting.later = timedelta(minutes=6)
    resting.desk.participant_does(1, acts.EndBreak(part=resting.desk.conductor.now(1).name))
    for _ in range(3):
        begin(resting)
        resting.trials.finish()
    for _ in range(4):
        fill(resting)
    assert stage(resting).how == "finished"
    assert row(resting).state == "finished"


def test_who_is_enrolled_may_be_written_down_apart_and_is_deleted_with_all_else(study):
    study.desk.console_does(acts.Enrol(number=2, language="en", name=" Bea "))
    assert study.desk.personal.names() == {2: "Bea"}
    assert not any("Bea" in str(event) for event in study.events)
    study.desk.participant_does(2, acts.Withdraw(delete=False))
    assert study.desk.personal.names() == {2: "Bea"}
    study.desk.console_does(acts.WithdrawFor(number=2, delete=True))
    assert study.desk.personal.names() == {}


def test_nobody_is_shown_the_robots_page_before_it_is_there(ready):
    begin(ready)
    ready.trials.ready = False
    assert stage(ready) == Wait(why="starting")
    ready.trials.ready = True
    assert isinstance(stage(ready), Trial)
