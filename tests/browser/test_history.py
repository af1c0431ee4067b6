"""The history of the skill on the page: what it shows of each entry, and how entries are taken back and used again."""

from dataclasses import replace
from itertools import pairwise

import msgspec
import pytest
from lessons import VERSION, effect, history

from protocol.queries import Refused
from services.station.press import Press

TURNS = ("take_back", "use_again")
ASKED = (
    "performance.getEntriesByType('resource').filter(({name}) => /history.*[/]6/.test(name))"
    ".map(({startTime}) => startTime)"
)
"""When the newest entry was asked for [ms]."""

SELDOM_MS = 1000.0


@pytest.fixture
def learnt(station, tab, eventually):
    """A page that shows a history of four entries, and can change it."""
    page, feed = station
    offered = ("execute", "confidence", *TURNS)
    told = msgspec.structs.replace(feed.view.teaching, phase="deciding", actions=offered, confidence=0.7)
    page.effects.renew(0)
    page.effects.renew(VERSION)
    feed.view = replace(feed.view, teaching=told, history=history())
    tab.wait(".entry:nth-child(4)")
    yield tab
    page.effects.renew(0)  # the next test's tab shall hear nothing of this one's


def row(number):
    return f".entry[data-entry='{number}']"


def test_each_entry_says_what_it_is_by_whom_how_and_by_how_much(learnt):
    assert learnt.page.locator(".entry .entry-what").all_inner_texts() == [
        "Correction 6",
        "Correction 5",
        "First demonstration 2",
        "First demonstration 1",
    ]
    said = learnt.page.locator(row(5)).inner_text()
    for words in ("anna", "while it moved", "believed 70 %", "up to 38 mm, 12 mm on average"):
        assert words in said
    assert "taken back by eva" in learnt.page.locator(row(2)).inner_text()
    learnt.wait("[data-value=skill-count]:text-is('Version 7: 3 of 4 in use')")


@pytest.mark.parametrize(("number", "label", "action"), [(5, "Undo", "take_back"), (2, "Redo", "use_again")])
def test_an_entry_is_taken_back_or_used_again_once_that_is_confirmed(learnt, presses, number, label, action):
    learnt.page.click(f"{row(number)} .turn:text-is('{label}')")
    learnt.wait(".confirm-text")
    learnt.page.click(".confirm-yes")
    assert presses() == [Press(action, str(number))]


def test_what_is_not_confirmed_is_not_done(learnt, station):
    learnt.page.click(f"{row(5)} .turn")
    learnt.page.click(".confirm-no")
    learnt.wait(".confirm", state="hidden")
    learnt.page.wait_for_timeout(300)
    assert station[0].take_presses() == []


def test_where_the_workflow_does_not_offer_it_nothing_can_be_turned(learnt, station):
    _, feed = station
    feed.view = replace(feed.view, teaching=msgspec.structs.replace(feed.view.teaching, actions=("finish",)))
    learnt.wait(f"{row(5)} .turn:disabled")


def test_what_an_entry_changed_is_seen_as_soon_as_it_is_there_and_drawn_where_it_is_looked_at(learnt, station):
    page, _ = station
    assert learnt.page.locator(f"{row(6)} svg").count() == 0
    page.effects.put(VERSION, 6, effect())
    learnt.wait(f"{row(6)} .entry-map[aria-label*='up to 40 mm'] rect")
    assert learnt.page.locator(f"{row(6)} rect.hollow").count() > 0
    assert not learnt.shows(".legend-with")
    learnt.page.hover(f"{row(6)} .entry-show")
    learnt.wait("body[data-comparing] .legend-with")
    learnt.page.hover(".header")
    learnt.wait("body:not([data-comparing])")


def test_all_is_reached_by_key_and_what_has_the_focus_is_compared(learnt, station, presses):
    page, _ = station
    page.effects.put(VERSION, 5, effect())
    learnt.wait(f"{row(5)} rect")
    learnt.page.focus(f"{row(5)} .entry-show")
    learnt.wait("body[data-comparing]")
    learnt.page.keyboard.press("Tab")
    learnt.page.keyboard.press("Enter")
    learnt.wait(".confirm-text")
    learnt.page.focus(".confirm-yes")
    learnt.page.keyboard.press("Enter")
    assert presses() == [Press("take_back", "5")]


def test_another_model_s_history_takes_the_place_of_the_old_one(learnt, station):
    page, feed = station
    page.effects.put(VERSION, 6, effect())
    learnt.wait(f"{row(6)} rect")
    page.effects.renew(VERSION + 1)
    feed.view = replace(feed.view, history=history(VERSION + 1, taken_back=(2, 6)))
    learnt.wait(f"{row(6)}[data-used=no] .turn:text-is('Redo')")
    page.effects.put(VERSION + 1, 6, effect(0.002))
    learnt.wait(f"{row(6)} .entry-map[aria-label='Moves no prediction by more than 5 mm.']")


def test_how_sure_somebody_is_is_told_where_it_is_set_and_shown_as_it_counts(learnt, presses):
    learnt.wait("[data-value=confidence-share]:text-is('70 %')")
    assert learnt.page.input_value("#confidence") == "0.7"
    learnt.page.focus("#confidence")
    learnt.page.keyboard.press("ArrowLeft")
    assert presses() == [Press("confidence", "0.65")]


def test_an_entry_that_was_clicked_stays_compared_until_it_is_clicked_again(learnt, station):
    page, _ = station
    page.effects.put(VERSION, 5, effect())
    learnt.wait(f"{row(5)} rect")
    learnt.page.click(f"{row(5)} .entry-show")
    learnt.page.hover(".header")
    learnt.wait(f"{row(5)} .entry-show[aria-pressed=true]")
    learnt.wait("body[data-comparing] .legend-changed:has-text('up to 40 mm')")
    learnt.page.click(f"{row(5)} .entry-show")
    learnt.page.hover(".header")
    learnt.wait(f"{row(5)} .entry-show[aria-pressed=false]")
    learnt.wait("body:not([data-comparing])")


def test_that_an_entry_was_clicked_is_said_at_once_and_how_long_what_it_changed_is_waited_for(
    learnt, station, eventually
):
    page, _ = station
    learnt.page.click(f"{row(1)} .entry-show")
    learnt.wait(f"{row(1)} .entry-show[aria-pressed=true]")
    learnt.wait(f"{row(1)} .entry-told:has-text('work')")
    learnt.wait(".legend-changed:has-text('work')")
    eventually(lambda: page.effects.wanted() == 1)  # of four that are not there the one that is looked at
    learnt.wait(f"{row(1)} .entry-told:has-text('Still being worked out after')")
    page.effects.put(VERSION, 1, effect())
    learnt.wait(f"{row(1)} .entry-told:has-text('up to 40 mm')")
    learnt.wait("body[data-comparing] .legend-changed:has-text('up to 40 mm')")


def test_an_entry_whose_effect_is_refused_says_why_where_it_is_clicked(learnt, station):
    page, _ = station
    page.effects.put(VERSION, 5, Refused("entry 5 cannot be compared: it is too short"))
    learnt.page.click(f"{row(5)} .entry-show")
    learnt.wait(f"{row(5)} .entry-told:has-text('Not to be shown: entry 5 cannot be compared: it is too short')")
    assert not learnt.page.locator("body[data-comparing]").count()


def test_what_was_clicked_is_compared_in_the_next_model_too(learnt, station):
    page, feed = station
    page.effects.put(VERSION, 5, effect())
    learnt.page.click(f"{row(5)} .entry-show")
    learnt.wait(f"{row(5)} .entry-told:has-text('up to 40 mm')")
    page.effects.renew(VERSION + 1)
    feed.view = replace(feed.view, history=history(VERSION + 1))
    learnt.wait(f"{row(5)} .entry-told:has-text('work')")
    page.effects.put(VERSION + 1, 5, effect(0.03))
    learnt.wait(f"{row(5)} .entry-told:has-text('up to 30 mm')")


def test_however_often_a_pointer_comes_by_an_entry_is_asked_for_by_one_chain_of_questions(learnt, eventually):
    for _ in range(12):
        learnt.page.hover(f"{row(6)} .entry-what")
        learnt.page.hover(f"{row(5)} .entry-what")
    learnt.page.hover(".header")
    learnt.page.evaluate("performance.clearResourceTimings()")
    eventually(lambda: len(learnt.page.evaluate(ASKED)) > 3)
    begun = learnt.page.evaluate(ASKED)
    assert min(after - before for before, after in pairwise(begun)) > SELDOM_MS
