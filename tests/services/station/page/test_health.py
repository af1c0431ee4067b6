"""In the page's header: whether what is shown can be trusted, and the figures behind it."""

from dataclasses import replace

import msgspec
import pytest
from views import SEATED, robot, shown

from protocol.messages import AuthorityState, ModelState, Phase, Recording, Way
from services.bus.arrays import motion_to_wire
from services.bus.stages import Stages
from services.process.clock import ManualClock
from services.process.load import Load
from services.station.page.health import commander, figures, health
from services.station.page.view import Board, Picture
from services.station.words.table import speech
from tests.services.predictions import prediction

MOTION = motion_to_wire([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[1.0, 0.0, 0.0, 0.0]] * 2, 1.0)
LOOKING_ON = replace(SEATED, armed=False)
WELL = {
    "robot": robot(Phase.IDLE, applied_latency=0.024),
    "robot_age_s": 0.01,
    "model": ModelState(kind="adaptive", version=7, demonstrations=12, updates=2, scene="table"),
    "path": Stages(capture=0.012, way=0.018, apply=0.006, motion=0.020, picture=0.031),
}
BUSY = "This computer is too busy: 22 programs want its {}; motions will hold."


@pytest.mark.parametrize(
    ("mine", "standing", "words"),
    [(True, SEATED, "yours"), (True, LOOKING_ON, "anna"), (False, SEATED, "anna")],
)
def test_the_authority_is_the_reader_s_only_where_s_he_has_the_input(mine, standing, words):
    authority = AuthorityState(holder="station-1", operator="anna", epoch=1, expires_in=1.0)
    view = shown(authority=authority, authority_is_mine=mine)
    assert commander(view, standing)["figure-authority"] == words


def test_an_authority_that_nobody_holds_is_nobody_s():
    assert commander(shown(), SEATED)["figure-authority"] == "nobody"


@pytest.mark.parametrize(
    ("changes", "tone", "words"),
    [
        ({}, "good", "All well"),
        ({"robot": None}, "bad", "The robot is not heard"),
        ({"robot_age_s": 1.4}, "bad", "Robot data 1.4 s old"),
        ({"model": None}, "warn", "The model is not heard"),
        ({"cameras": {"head": Picture(b"", 0.2), "wrist": Picture(b"", 2.9)}}, "warn", "Pictures 2.9 s old"),
        ({"cameras": {"head": Picture(b"", 0.2)}}, "good", "All well"),
        ({"robot": robot(Phase.IDLE, applied_latency=0.12)}, "warn", "Slow: 120 ms from hand to robot"),
        (
            {"recording": Recording(path="a", viewer_url="", recording_id="r", fault="full")},
            "warn",
            "Recording is at fault",
        ),
    ],
)
def test_health_is_the_worst_that_there_is_to_say(changes, tone, words):
    assert health(shown(**{**WELL, **changes})) == {"health@data-tone": tone, "health-text": words}


@pytest.mark.parametrize(
    ("load", "changes", "tone", "words"),
    [
        (Load(7.9, 2), {}, "good", "All well"),
        (Load(22.4, 2), {"model": None}, "warn", BUSY.format("2 processors")),
        (Load(22.4, 1), {}, "warn", BUSY.format("one processor")),
        (Load(22.4, 2), {"robot": None}, "bad", "The robot is not heard"),
    ],
)
def test_a_computer_that_is_too_busy_is_named_before_what_comes_of_it(load, changes, tone, words):
    told = health(replace(shown(**{**WELL, **changes}), load=load))
    assert told == {"health@data-tone": tone, "health-text": words}


def test_the_load_is_looked_at_whenever_it_is_shown():
    loads = iter([Load(1.0, 2), Load(22.0, 2)])
    board = Board(ManualClock(), lambda: next(loads))
    assert [board.newest().load for _ in range(2)] == [Load(1.0, 2), Load(22.0, 2)]


def test_the_figures_say_what_was_measured():
    told = figures(shown(**WELL))
    assert (told["figure-phase"], told["figure-age"]) == ("stands", "10 ms")
    assert (told["figure-latency"], told["figure-model"]) == ("24 ms", "v7, 2 learnt")


@pytest.mark.parametrize(
    ("path", "total", "stages"),
    [
        (WELL["path"], "87 ms", "12 + 18 + 6 + 20 + 31 ms"),
        (Stages(way=0.018, apply=0.006, picture=0.031), "at least 55 ms", "? + 18 + 6 + ? + 31 ms"),
        (Stages(), "none", "none"),
    ],
)
def test_the_way_from_hand_to_eye_is_told_by_its_stages_and_what_is_unknown_counts_as_nothing(path, total, stages):
    told = figures(shown(**{**WELL, "path": path}))
    assert (told["figure-path"], told["figure-stages"]) == (total, stages)


def test_what_is_limited_is_said_in_a_person_s_words_and_once():
    told = figures(shown(("speed arm_3_joint", "speed arm_3_joint", "displacement", "reach: 12 mm short")))
    assert told["figure-limited"] == "joint speed (arm_3_joint), correction too far, out of reach (12 mm short)"
    assert told["limited"].startswith("Limited: joint speed")
    assert figures(shown())["limited"] == ""
    assert figures(shown(("something new",)))["figure-limited"] == "something new"


def test_by_how_much_it_is_limited_is_said_in_the_pages_language():
    speech.speak("de")
    try:
        told = figures(shown(("reach: 12 mm short", "reach: 16 degrees short")))
    finally:
        speech.speak("en")
    assert told["figure-limited"] == "außer Reichweite (es fehlen 12 mm), außer Reichweite (es fehlen 16°)"


@pytest.mark.parametrize(
    ("certainty", "words", "tone"),
    [
        ({}, "100 % known", "good"),
        ({"known": 0.5}, "50 % known", "good"),
        ({"known": 0.2}, "20 % known", "warn"),
        ({"known": 0.6, "way": Way(1, 2, 0.8)}, "60 % known, way 2 of 2, 80 %", "good"),
    ],
)
def test_a_prediction_is_told_by_what_is_known_and_which_way_it_takes(certainty, words, tone):
    told = figures(shown(prediction=msgspec.structs.replace(prediction(MOTION), **certainty)))
    assert (told["figure-prediction"], told["figure-prediction@data-tone"]) == (words, tone)


def test_without_a_prediction_nothing_is_said_of_it():
    told = figures(shown())
    assert (told["figure-prediction"], told["figure-prediction@data-tone"]) == ("none", "none")


def test_a_network_that_is_open_to_others_is_said_whatever_else_there_is_to_say():
    well = health(shown(**WELL, open_network=True))
    assert well == {"health@data-tone": "warn", "health-text": "All well. Network open to others"}
    unheard = health(shown(open_network=True))
    assert unheard == {"health@data-tone": "bad", "health-text": "The robot is not heard. Network open to others"}
    told = figures(shown(open_network=True))
    assert told["figure-network@data-tone"] == "warn"
    assert "open to others" in told["figure-network"]
    assert figures(shown())["figure-network"] == "closed to others"
