"""What only the browser knows of the way from hand to eye, and where a person reads of all of it."""

import pytest

from services.process.clock import SystemClock

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

FED_S = 0.02
"""Age of the pictures that the harness feeds when the station has them."""


def test_the_page_says_when_keys_were_read_and_how_old_its_pictures_were_when_drawn(hand, station, eventually):
    page, _ = station
    hand.hold("KeyE")
    eventually(lambda: page.take_input().captured_ns and page.take_input().drawn >= 0.0)
    held = page.take_input()
    assert 0 < held.captured_ns <= SystemClock().now_ns()
    assert held.drawn >= FED_S
    hand.let_go()


def test_the_way_from_hand_to_eye_is_read_where_the_figures_are(tab):
    tab.page.click(".health summary")
    tab.wait("[data-value=figure-path]:text-is('87 ms')")
    tab.wait("[data-value=figure-stages]:text-is('12 + 18 + 6 + 20 + 31 ms')")
