"""The participant's page in a browser: consent, forms, trials, break, withdrawal, two languages."""

from datetime import timedelta

import pytest
from study_person import agree, answer, missing, parts, send, set_

from services.study.events import Answered, Consented, Withdrawn
from services.study.page.acts import Begin

pytest.importorskip("uvicorn")
from playwright.sync_api import expect

pytestmark = pytest.mark.browser


@pytest.fixture
def tab(study, visit):
    """A participant's page."""
    return visit(study.page.participant_url(1))


def events(study, kind):
    return [event for event in study.events if isinstance(event, kind)]


def to_the_tlx(study, tab):
    """Up to the questionnaire after the first method."""
    study.desk.conductor.consent(1, "en")
    parts(study, 4)
    tab.wait_for_selector("[data-question=mental]")


def test_a_consent_is_an_act_of_ones_own(study, tab):
    expect(tab.locator("h1")).to_have_text("Before you take part")
    expect(tab.locator("#agree")).not_to_be_checked()
    tab.click("button.go")
    expect(tab.locator(".problem")).to_have_text("Tick the box first, if you agree.")
    assert not events(study, Consented)
    agree(tab)
    tab.wait_for_selector("[data-question=gender]")
    (consented,) = events(study, Consented)
    assert (consented.version, consented.language) == ("2", "en")
    assert tab.faults == []


def test_a_form_is_refused_until_it_is_complete_and_says_what_is_missing(study, tab):
    agree(tab)
    tab.wait_for_selector("[data-question=gender]")
    assert set_(tab) == []  # nothing is pre-set
    answer(tab, but=("field", "handedness"))
    send(tab)
    assert missing(tab) == ["field", "handedness"]
    expect(tab.locator(".form .problem")).to_contain_text("There is something missing still: 2")
    assert not events(study, Answered)
    tab.fill("[data-question=field] input", "mechanical engineering")
    tab.locator("[data-question=handedness] input").first.check()
    assert missing(tab) == []
    send(tab)
    expect(tab.locator("h1")).to_have_text("Training")
    (answered,) = events(study, Answered)
    assert answered.answers["field"] == "mechanical engineering"


def test_a_form_is_filled_in_by_the_keyboard_alone(study, tab):
    agree(tab)
    tab.wait_for_selector("[data-question=gender]")
    tab.focus("[data-question=gender] input >> nth=0")
    for question in ("gender", "age", "field", "technical", "gaming", "teleoperation", "handedness"):
        here = tab.evaluate("document.activeElement.closest('[data-question]').dataset.question")
        assert here == question
        if question == "field":
            tab.keyboard.type("law")
        else:
            tab.keyboard.press("Space")
            tab.keyboard.press("ArrowRight")
        tab.keyboard.press("Tab")
    tab.keyboard.press("Enter")
    expect(tab.locator("h1")).to_have_text("Training")
    (answered,) = events(study, Answered)
    assert answered.answers["gender"] == "man"


def test_what_is_half_filled_in_survives_a_reload_and_is_recorded_nowhere(study, tab):
    agree(tab)
    answer(tab, but=("age",))
    tab.reload()
    tab.wait_for_selector("[data-question=gender]")
    assert set(set_(tab)) == {"gender", "field", "technical", "gaming", "teleoperation", "handedness"}
    assert not events(study, Answered)


def test_what_another_participant_half_filled_in_is_not_shown(study, tab):
    study.desk.conductor.enrol(2, "en")
    study.desk.conductor.consent(2, "en")
    agree(tab)
    answer(tab)
    tab.goto(study.page.participant_url(2))
    tab.wait_for_selector("[data-question=gender]")
    assert set_(tab) == []


def test_a_tlx_is_refused_until_scales_and_cards_are_complete(study, tab):
    to_the_tlx(study, tab)
    assert set_(tab) == []
    assert tab.locator("[data-question=mental] input").count() == 21
    answer(tab, but=("effort",))
    send(tab)
    assert missing(tab) == ["effort"]
    tab.locator("[data-question=effort] input").nth(20).check(force=True)
    send(tab)
    expect(tab.get_by_text("Card 1 of 15")).to_be_visible()
    for number in range(1, 15):
        tab.locator(".card").first.click()
        expect(tab.get_by_text(f"Card {number + 1} of 15")).to_be_visible()
    expect(tab.locator("form button.go")).to_be_hidden()
    tab.reload()
    expect(tab.get_by_text("Card 15 of 15")).to_be_visible()
    tab.locator(".card").first.click()
    send(tab)
    tab.wait_for_selector("[data-question=q1]")
    (answered,) = events(study, Answered)[-1:]
    scored = study.desk.instruments["nasa_tlx"].scored(answered.answers)
    assert answered.answers["effort"] == 100
    assert len(answered.answers) == 21
    assert 50.0 <= scored["workload"] <= 100.0


def test_a_card_can_be_taken_back(study, tab):
    to_the_tlx(study, tab)
    answer(tab)
    send(tab)
    tab.locator(".card").first.click()
    expect(tab.get_by_text("Card 2 of 15")).to_be_visible()
    tab.get_by_role("button", name="Back").click()
    expect(tab.locator(".card").first).to_have_attribute("aria-pressed", "true")
    tab.get_by_role("button", name="Back").click()
    tab.wait_for_selector("[data-question=mental]")
    assert "mental" in set_(tab)


def test_a_trial_shows_the_robots_page_and_its_attempts(study, tab):
    study.desk.conductor.consent(1, "en")
    parts(study, 1)
    expect(tab.locator("h1")).to_have_text("Training")
    tab.click("button.go")
    expect(tab.frame_locator("iframe").get_by_text("stands in for the robot's page")).to_be_visible()
    tab.evaluate("document.querySelector('iframe').dataset.same = 'yes'")
    study.trials.attempt(success=False)
    expect(tab.locator(".header-standing")).to_have_text(
        "Attempts: 1 · 0 of the last 4 succeeded (2 are needed); 30 min left"
    )
    assert tab.locator("iframe[data-same=yes]").count() == 1  # it was not loaded anew
    study.trials.finish()
    expect(tab.locator("h1")).to_have_text("Model 1 of 2")


@pytest.mark.parametrize("width", [700, 1000, 1280])
def test_the_way_out_and_how_a_training_stands_are_seen_whole_in_a_rehearsal_too(study, visit, width):
    study.desk.synthetic = True
    study.desk.conductor.consent(1, "de")
    parts(study, 1)
    study.desk.participant_does(1, Begin(part=study.desk.conductor.now(1).name, language="de"))
    tab = visit(study.page.participant_url(1), viewport={"width": width, "height": 720})
    standing = tab.locator(".header-standing")
    expect(standing).to_contain_text("0 der letzten 4 gelungen (2 nötig); noch 30 min")
    assert standing.evaluate("one => one.scrollWidth <= one.clientWidth")
    for one in ("#withdraw", ".rehearsal"):
        box = tab.locator(one).bounding_box()
        assert box["x"] + box["width"] <= width


def test_a_break_counts_down_and_lets_nobody_go_on_before(study, tab):
    study.desk.conductor.consent(1, "en")
    parts(study, 6)
    expect(tab.locator(".countdown")).to_contain_text("left")
    expect(tab.locator("button.go")).to_be_disabled()
    study.later = timedelta(minutes=5)
    expect(tab.locator("button.go")).to_be_enabled()
    tab.click("button.go")
    expect(tab.locator("h1")).to_have_text("Training")


@pytest.mark.parametrize(("press", "deleted"), [("Stop, and keep it", False), ("Stop, and delete it", True)])
def test_a_withdrawal_takes_two_steps_and_may_take_along_what_was_recorded(study, tab, press, deleted):
    agree(tab)
    tab.click("#withdraw")
    tab.get_by_role("button", name="No, go on").click()
    assert not events(study, Withdrawn)
    tab.click("#withdraw")
    tab.get_by_role("button", name="Yes, stop").click()
    assert not events(study, Withdrawn)
    tab.get_by_role("button", name=press).click()
    expect(tab.locator("h1")).to_have_text("You take part no longer")
    (withdrawn,) = events(study, Withdrawn)
    assert withdrawn.delete is deleted
    assert bool(events(study, Consented)) is not deleted
    assert tab.locator("#withdraw").count() == 0


def test_a_withdrawal_during_a_trial_stops_the_robot(study, tab):
    study.desk.conductor.consent(1, "en")
    parts(study, 1)
    expect(tab.locator("h1")).to_have_text("Training")
    tab.click("button.go")
    tab.wait_for_selector("iframe")
    tab.click("#withdraw")
    tab.get_by_role("button", name="Yes, stop").click()
    tab.get_by_role("button", name="Stop, and keep it").click()
    expect(tab.locator("h1")).to_have_text("You take part no longer")
    assert study.trials.live() is None


def test_a_language_is_chosen_and_written_down_with_what_is_read_in_it(study, tab, visit):
    tab.select_option(".language", "de")
    expect(tab.locator("h1")).to_have_text("Bevor Sie teilnehmen")
    assert tab.evaluate("document.documentElement.lang") == "de"
    agree(tab)
    expect(tab.locator("legend").first).to_have_text("Geschlecht")
    answer(tab)
    tab.select_option(".language", "nl")
    expect(tab.locator("legend").first).to_have_text("Gender")
    assert "field" in set_(tab)
    send(tab)
    expect(tab.locator("h1")).to_have_text("Oefening")
    (consented,), (answered,) = events(study, Consented), events(study, Answered)
    assert (consented.language, answered.language) == ("de", "nl")
    expect(visit(study.page.participant_url(1)).locator("h1")).to_have_text("Oefening")
    tab.select_option(".language", "de")
    tab.click("button.go")
    tab.wait_for_selector("iframe")
    assert study.trials.started == [(1, "OnKey/training", "de")]


def test_two_browsers_on_one_session_show_the_same(study, tab, visit):
    other = visit(study.page.participant_url(1), locale="de")
    agree(tab)
    other.wait_for_selector("[data-question=gender]")
    answer(other)
    send(other)
    expect(tab.locator("h1")).to_have_text("Training")


def test_a_number_that_nobody_has_is_told(study, visit):
    tab = visit(study.page.participant_url(7))
    expect(tab.locator(".problem")).to_contain_text("There is no participant 7")
    tab.fill("[name=number]", "1")
    tab.click("button.go")
    expect(tab.locator("h1")).to_have_text("Before you take part")
