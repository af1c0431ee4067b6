"""What was interrupted goes on, or not, as the protocol and the experimenter say; nothing of it is lost."""

from datetime import timedelta

import pytest

from services.study import events
from services.study.exceptions import NotNow
from services.study.page import acts
from services.study.page.console import console_view
from services.study.page.participant import End, Trial, Wait
from tests.services.study.page.acting import agree, begin, fill, row, stage


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


def test_a_part_that_runs_and_is_invalid_without_repetition_is_over_and_the_next_one_comes(ready):
    begin(ready)
    part = ready.desk.conductor.now(1).name
    ready.desk.console_does(acts.Invalid(number=1, part=part, reason="wrong device", repeat=False))
    assert ready.trials.live() is None
    assert ready.desk.conductor.now(1).name == "OnKey/1"
    assert not stage(ready).resumed
    (told,) = [done for done in console_view(ready.desk, 1, "v").parts if done.part.name == part]
    assert (told.state, told.invalid) == ("invalid", "wrong device")
    begin(ready)
    assert ready.trials.started[-1][1] == "OnKey/1"


def test_an_earlier_part_is_not_repeated_while_another_one_of_theirs_runs(ready):
    begin(ready)
    earlier = acts.Invalid(number=1, part="participant", reason="typed by somebody else", repeat=True)
    with pytest.raises(NotNow, match="OnKey/training of participant 1 runs: interrupt it first, or wait for its end"):
        ready.desk.console_does(earlier)
    assert isinstance(stage(ready), Trial)
    ready.desk.console_does(acts.Pause(number=1, reason=""))
    ready.desk.console_does(earlier)
    assert ready.desk.conductor.now(1).name == "participant"


def test_what_is_refused_for_want_of_a_reason_stops_nothing(ready):
    begin(ready)
    with pytest.raises(NotNow, match="say why"):
        ready.desk.console_does(acts.Invalid(number=1, part="OnKey/training", reason=" ", repeat=True))
    assert isinstance(stage(ready), Trial)


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


def test_what_was_deleted_is_deleted_once_and_said_so_to_the_experimenter(ready):
    ready.desk.console_does(acts.WithdrawFor(number=1, delete=False))
    assert row(ready).state == "withdrawn"
    ready.desk.console_does(acts.WithdrawFor(number=1, delete=True))
    assert row(ready).state == "deleted"
    with pytest.raises(NotNow, match="has withdrawn already"):
        ready.desk.console_does(acts.WithdrawFor(number=1, delete=True))


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
