"""From the page's reading of what is held to the first sample that follows it: where it changes, and is known."""

import pytest

from protocol.messages import Controller, OperatorInput
from services.bus.identity import new_publisher
from services.bus.stages import from_figures
from services.master.capture import Capture

MS = 1_000_000
OWN = new_publisher()
NOW_NS = 50_000 * MS


def held(*keys, age_ms=8.0, publisher=OWN, controllers=(), known=True):
    captured_ns = NOW_NS - round(age_ms * MS) if known else 0
    return OperatorInput(keys=keys, controllers=controllers, captured_ns=captured_ns, publisher=publisher)


@pytest.fixture
def capture():
    one = Capture(OWN)
    one.sampled(held(), NOW_NS)
    return one


def test_what_changes_is_measured_from_when_the_page_read_it(capture):
    capture.sampled(held("KeyE"), NOW_NS)
    assert capture.newest_s == pytest.approx(0.008)


def test_a_stick_that_moves_is_a_change_too(capture):
    capture.sampled(held(controllers=(Controller("gamepad", axes=(0.1,)),)), NOW_NS)
    assert capture.newest_s == pytest.approx(0.008)


def test_what_stays_held_is_measured_once(capture):
    capture.sampled(held("KeyE"), NOW_NS)
    capture.sampled(held("KeyE", age_ms=19.0), NOW_NS)
    assert capture.newest_s == pytest.approx(0.008)
    assert from_figures(capture.take_figures()).capture == pytest.approx(0.008)
    assert capture.take_figures() == ()


@pytest.mark.parametrize(
    "unknown", [{"known": False}, {"publisher": OWN ^ (1 << 50)}, {"age_ms": 2000.0}, {"age_ms": -1.0}]
)
def test_what_cannot_be_known_is_unknown_and_no_earlier_figure_stands_for_it(capture, unknown):
    capture.sampled(held("KeyE"), NOW_NS)
    capture.sampled(held("KeyQ", **unknown), NOW_NS)
    assert capture.newest_s == -1.0


def test_a_page_that_is_heard_again_has_not_changed_anything(capture):
    capture.sampled(None, NOW_NS)
    capture.sampled(held("KeyE"), NOW_NS)
    assert capture.newest_s == -1.0
