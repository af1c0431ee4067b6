"""The experimenter's console in a browser, beside the participant's page."""

from datetime import timedelta

import pytest
from study_person import agree, answer, parts, send

from services.study.events import Dropped, Enrolled, Invalid, Noted, Paused

pytest.importorskip("uvicorn")
from playwright.sync_api import expect

pytestmark = pytest.mark.browser


@pytest.fixture
def console(study, visit):
    """A console that looks at participant 1."""
    tab = visit(study.page.console_url)
    tab.click(".person[data-number='1']")
    tab.wait_for_selector(".part")
    return tab


def events(study, kind):
    return [event for event in study.events if isinstance(event, kind)]


def state(console, number=1):
    return console.locator(f".person[data-number='{number}'] .person-state")


def trial(study):
    """Participant 1's training runs."""
    study.desk.conductor.consent(1, "en")
    parts(study, 1)
    from services.study.page import acts

    study.desk.participant_does(1, acts.Begin(part=study.desk.conductor.now(1).name, language="en"))


def test_a_participant_is_enrolled_with_the_next_number_and_a_number_twice_is_one_line(study, console):
    number = console.locator(".enrol input.short")
    expect(number).to_have_value("2")
    console.click(".enrol button")
    expect(state(console, 2)).to_have_text("at a form")
    assert [event.participant for event in events(study, Enrolled)] == [1, 2]
    number.fill("1")
    console.click(".enrol button")
    expect(console.locator(".enrol .problem")).to_have_text(
        "there is a participant 1 already: each number is one person's"
    )
    assert len(events(study, Enrolled)) == 2


def test_console_and_participant_see_each_other_at_once(study, console, visit):
    participant = visit(study.page.participant_url(1))
    agree(participant)
    answer(participant)
    send(participant)
    expect(state(console)).to_have_text("about to begin")
    participant.click("button.go")
    expect(state(console)).to_have_text("runs")
    expect(console.locator(".now")).to_contain_text("Participant 1")
    study.trials.attempt(success=True)
    expect(console.locator(".now dd").first).to_have_text("1")
    console.click("[data-action=pause]")
    console.fill("#reason", "a phone rings")
    console.click(".dialog .button.go")
    expect(participant.locator(".lead")).to_contain_text("The experimenter has interrupted")
    assert events(study, Paused)[0].reason == "a phone rings"
    console.click("[data-action=go_on]")
    participant.wait_for_selector("iframe")
    assert (console.faults, participant.faults) == ([], [])


def test_what_does_not_count_wants_a_reason_and_is_repeated_or_not(study, console):
    trial(study)
    study.trials.attempt(success=False)
    console.click("[data-part$=training] [data-action=invalid]")
    console.get_by_role("button", name="Invalid, and repeat it").click()
    expect(console.locator(".dialog .problem")).to_have_text("Write a reason first.")
    assert not events(study, Invalid)
    console.fill("#reason", "wrong device")
    console.get_by_role("button", name="Invalid, and repeat it").click()
    expect(console.locator(".person-invalid")).to_have_text("1 invalid")
    (invalid,) = events(study, Invalid)
    assert (invalid.reason, invalid.repeat) == ("wrong device", True)
    assert study.trials.live() is None


@pytest.mark.parametrize(("action", "attempts"), [("go_on_all_the_same", 1), ("anew", 0)])
def test_an_old_checkpoint_is_the_experimenters_decision(study, console, visit, action, attempts):
    trial(study)
    study.trials.attempt(success=False)
    study.trials.running = None  # the robot's process has died
    study.later = timedelta(minutes=20)
    participant = visit(study.page.participant_url(1))
    expect(participant.locator(".lead")).to_contain_text("Please tell the experimenter")
    expect(console.locator(".decision")).to_contain_text("20 min old, of at most 15 min")
    console.click(f"[data-action={action}]")
    if action == "anew":
        console.get_by_role("dialog").get_by_role("button", name="Begin the part anew").click()
    participant.wait_for_selector("iframe")
    expect(participant.get_by_text(f"Attempts: {attempts}")).to_be_visible()


def test_a_session_is_ended_with_a_reason_and_its_order_is_open_again(study, console):
    console.click("[data-tab=allocation]")
    expect(console.locator(".allocation tbody tr.quiet")).to_have_count(5)
    console.click("[data-tab=session]")
    console.click("[data-action=abort]")
    console.fill("#reason", "ill")
    console.get_by_role("button", name="End their session").click()
    expect(state(console)).to_have_text("gone")
    assert events(study, Dropped)[0].reason == "ill"
    console.click("[data-tab=allocation]")
    expect(console.locator(".allocation tbody tr.quiet")).to_have_count(6)


def test_who_is_gone_is_not_counted_and_what_was_deleted_is_not_offered_again(study, console):
    expect(console.locator(".people-panel h2")).to_have_text("Participants · 1 / 6")
    console.click("[data-action=withdraw]")
    console.get_by_role("button", name="Stop, and keep it").click()
    expect(state(console)).to_have_text("withdrawn")
    expect(console.locator(".people-panel h2")).to_have_text("Participants · 0 / 6")
    console.click("[data-action=delete]")
    console.get_by_role("button", name="Delete it").click()
    expect(state(console)).to_have_text("withdrawn, deleted")
    expect(console.locator("[data-action=withdraw], [data-action=delete]")).to_have_count(0)


def test_what_is_wrong_with_what_runs_is_told(study, console):
    trial(study)
    study.trials.ready = False
    expect(console.locator(".now-acting")).to_have_text("The robot is being made ready.")
    study.trials.fault = "the disk is full"
    expect(console.locator(".now .problem")).to_have_text("the disk is full")


def test_a_rehearsal_is_marked_on_both_pages(study, visit):
    study.desk.synthetic = True
    for address in (study.page.console_url, study.page.participant_url(1)):
        expect(visit(address, locale="de").locator(".rehearsal")).to_be_visible()


def test_notes_are_written_about_a_participant_or_the_study(study, console):
    console.click("[data-tab=notes]")
    console.fill(".note-form textarea", "Somebody <b>came</b> in.")
    console.click(".note-form button")
    expect(console.locator(".note-text").first).to_have_text("Somebody <b>came</b> in.")
    console.select_option(".note-form select", "")
    console.fill(".note-form textarea", "The stylus was calibrated.")
    console.click(".note-form button")
    expect(console.locator(".note-text").first).to_have_text("The stylus was calibrated.")
    assert [(note.participant, note.text) for note in events(study, Noted)] == [
        (1, "Somebody <b>came</b> in."),
        (None, "The stylus was calibrated."),
    ]


def test_a_second_console_shows_the_same(study, console, visit):
    other = visit(study.page.console_url, locale="de")
    expect(other.locator(".header-title")).to_have_text("Versuchsleitung")
    console.click(".enrol button")
    expect(state(other, 2)).to_have_text("an einem Formular")


def test_what_is_typed_stays_while_others_act(study, console):
    console.click("[data-tab=notes]")
    console.locator(".note-form textarea").press_sequentially("half")
    study.desk.conductor.enrol(2, "en")
    expect(state(console, 2)).to_be_visible()
    console.keyboard.type(" a sentence")
    assert console.input_value(".note-form textarea") == "half a sentence"


def test_a_console_with_a_key_opens_to_nobody_without_it(tmp_path, visit):
    from tests.ports import free_port
    from tests.study_harness import served

    with served(tmp_path / "raw", free_port(), key="secret") as study:
        assert "told" in visit(study.page.console_url.replace("secret", "other")).inner_text("body")
        visit(study.page.console_url).wait_for_selector(".enrol")
