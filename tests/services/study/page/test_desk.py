"""What is done at the two pages counts once, at its time, and for what was seen; all of it is in the journal."""

from datetime import timedelta

import pytest

from services.study import events
from services.study.exceptions import AnswerRefused, NotNow, ParticipantThere, ParticipantUnknown
from services.study.page import acts
from services.study.page.console import console_view
from services.study.page.participant import Break, Consent, End, Form, Ready, Trial, Wait, participant_view
from tests.study_harness import Served


@pytest.fixture
def study(tmp_path):
    made = Served(tmp_path / "raw", 0, "http://127.0.0.1:1/")
    made.desk.console_does(acts.Enrol(number=1, language="en"))
    yield made
    made.journal.close()


def answers(study, number=1):
    """Complete ones to the form that a participant is at, the middle of everything."""
    part = study.desk.conductor.now(number)
    instrument = study.desk.instruments[part.instrument]
    found = {}
    for question in instrument.questions:
        kind = type(question).__name__
        for name in question.answers:
            found[name] = {
                "Scale": lambda q=question: q.ticks[len(q.ticks) // 2],
                "Choice": lambda q=question: q.options[0].name,
                "Text": lambda: "something",
                "Pairs": lambda n=name: n.split("/")[0],
            }[kind]()
    return found


def fill(study, number=1, **change):
    part = study.desk.conductor.now(number)
    version = study.desk.instruments[part.instrument].version
    said = {"part": part.name, "version": version, "language": "de", "answers": answers(study, number), **change}
    study.desk.participant_does(number, acts.Fill(**said))


def agree(study, number=1, version="2"):
    study.desk.participant_does(number, acts.Consent(version=version, language="de"))


def begin(study, number=1):
    study.desk.participant_does(number, acts.Begin(part=study.desk.conductor.now(number).name))


def stage(study, number=1):
    return participant_view(study.desk, number, "v").stage


def row(study, number=1):
    return next(row for row in console_view(study.desk, None, "v").rows if row.number == number)


@pytest.fixture
def ready(study):
    """A study whose participant is before the first training."""
    agree(study)
    fill(study)
    return study


@pytest.fixture
def resting(ready):
    """A study whose participant has a break."""
    for _ in range(3):
        begin(ready)
        ready.trials.finish()
    fill(ready)
    fill(ready)
    return ready


def test_nothing_comes_before_the_consent_to_the_text_that_was_shown(study):
    assert isinstance(stage(study), Consent)
    with pytest.raises(NotNow, match="version 1 of the text was shown, the study has 2"):
        agree(study, version="1")
    with pytest.raises(NotNow):
        study.desk.participant_does(1, acts.Begin(part="OnKey/training"))
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
    assert stage(ready) == Trial(url=ready.trials.url, attempts=0)
    ready.trials.attempt(success=True)
    assert stage(ready).attempts == 1
    assert row(ready).state == "runs"
    assert console_view(ready.desk, 1, "v").live.number == 1


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


def test_what_was_interrupted_a_moment_ago_goes_on_at_the_participants_press(ready):
    begin(ready)
    ready.trials.attempt(success=False)
    ready.trials.running = None  # the robot's process has died
    assert stage(ready).resumed
    assert row(ready).state == "interrupted"
    begin(ready)
    assert isinstance(stage(ready), Trial)
    assert ready.events[-1].by_hand is False
    assert stage(ready).attempts == 1


def test_what_was_interrupted_long_ago_is_the_experimenters_to_decide(ready):
    begin(ready)
    ready.trials.attempt(success=False)
    ready.trials.running = None
    ready.later = timedelta(minutes=16)
    assert stage(ready) == Wait(why="old")
    assert row(ready).old
    assert 960 <= row(ready).age_s < 970
    with pytest.raises(NotNow, match="last checkpoint is 16 minutes old"):
        begin(ready)
    part = ready.desk.conductor.now(1).name
    ready.desk.console_does(acts.GoOn(number=1, part=part))
    assert ready.events[-1].by_hand
    assert stage(ready).attempts == 1


def test_a_part_that_begins_anew_keeps_what_was_recorded_and_does_not_count_it(ready):
    begin(ready)
    ready.trials.attempt(success=False)
    ready.trials.running = None
    ready.later = timedelta(minutes=16)
    ready.desk.console_does(acts.GoOn(number=1, part=ready.desk.conductor.now(1).name, anew=True))
    assert stage(ready).attempts == 0
    assert len(ready.desk.conductor.participant(1).void) == 1


def test_what_the_experimenter_says_of_a_part_makes_its_checkpoint_no_younger(ready):
    begin(ready)
    ready.trials.attempt(success=False)
    ready.trials.running = None
    ready.later = timedelta(minutes=16)
    ready.desk.console_does(acts.Invalid(number=1, part="participant", reason="typed by somebody else", repeat=False))
    ready.desk.console_does(acts.Note(number=1, text="The power was cut."))
    assert stage(ready) == Wait(why="old")


def test_a_pause_stops_the_robot_and_the_page_waits_until_it_goes_on(ready):
    begin(ready)
    part = ready.desk.conductor.now(1).name
    ready.desk.console_does(acts.Pause(number=1, reason="a phone rings"))
    assert ready.trials.live() is None
    assert stage(ready) == Wait(why="paused")
    with pytest.raises(NotNow, match="pauses"):
        begin(ready)
    ready.desk.console_does(acts.GoOn(number=1, part=part))
    assert isinstance(stage(ready), Trial)


def test_a_pause_at_a_form_lets_nothing_be_handed_in(study):
    agree(study)
    study.desk.console_does(acts.Pause(number=1, reason="lunch"))
    with pytest.raises(NotNow, match="pauses"):
        fill(study)
    study.desk.console_does(acts.GoOn(number=1, part="participant"))
    fill(study)


def test_what_does_not_count_is_done_again_or_not_and_stops_what_runs(ready):
    begin(ready)
    part = ready.desk.conductor.now(1).name
    ready.trials.attempt(success=True)
    ready.desk.console_does(acts.Invalid(number=1, part=part, reason="wrong device", repeat=True))
    assert ready.trials.live() is None
    assert ready.desk.conductor.now(1).name == part
    with pytest.raises(NotNow, match="say why"):
        ready.desk.console_does(acts.Invalid(number=1, part="participant", reason=" ", repeat=False))
    shown = console_view(ready.desk, 1, "v").parts
    assert [len(done.void) for done in shown if done.part.name == part] == [1]


def test_who_withdraws_may_have_all_of_it_deleted_and_the_robot_stops(ready):
    begin(ready)
    ready.desk.participant_does(1, acts.Withdraw(delete=True))
    assert ready.trials.live() is None
    assert stage(ready).how == "deleted"
    assert not any(isinstance(event, events.Answered | events.Consented) for event in ready.events)


def test_who_withdrew_and_kept_it_may_have_it_deleted_later(ready):
    ready.desk.participant_does(1, acts.Withdraw(delete=False))
    assert stage(ready).how == "withdrawn"
    ready.desk.console_does(acts.WithdrawFor(number=1, delete=True))
    assert stage(ready).how == "deleted"


def test_who_is_ended_by_the_experimenter_sees_so_and_their_order_is_given_again(ready):
    coming = console_view(ready.desk, None, "v").coming
    ready.desk.console_does(acts.Abort(number=1, reason="ill"))
    assert isinstance(stage(ready), End)
    assert stage(ready).how == "gone"
    assert console_view(ready.desk, None, "v").coming == (ready.desk.conductor.participant(1).enrolled.order, *coming)


def test_a_note_wants_words_and_is_shown_newest_first(study):
    with pytest.raises(NotNow, match="write something first"):
        study.desk.console_does(acts.Note(number=None, text="  "))
    study.desk.console_does(acts.Note(number=None, text="first"))
    study.desk.console_does(acts.Note(number=1, text="second"))
    assert [(note.number, note.text) for note in console_view(study.desk, None, "v").notes] == [
        (1, "second"),
        (None, "first"),
    ]


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
