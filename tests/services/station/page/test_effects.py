"""What an entry changes is asked for by a tab, worked out elsewhere, and there when the tab asks again."""

import asyncio

import msgspec
import pytest
from starlette.requests import Request

from protocol.queries import Effect, Field, Refused
from services.bus.arrays import motion_to_wire, to_wire
from services.station.page.effects import KEPT, Effects

MOTION = motion_to_wire([[0.0, 0.0, 0.0], [1.0, 0.0, 0.5]], [[1.0, 0.0, 0.0, 0.0]] * 2, 1.0)
FIELD = Field((0, 1), (0.8, -0.1), (0.9, 0.2), *(to_wire([[0.01, 0.02], [0.03, 0.04]]) for _ in range(3)))
EFFECT = Effect((0.85, 0.05, 0.55), MOTION, None, FIELD)


def _ask(effects, version, entry, asked=b""):
    scope = {"type": "http", "path_params": {"version": version, "entry": entry}, "query_string": asked}
    return asyncio.run(effects.serve(Request(scope)))


@pytest.fixture
def effects():
    effects = Effects()
    effects.renew(5)
    return effects


def test_what_is_not_there_yet_is_wanted_until_it_is(effects):
    assert effects.wanted() is None
    assert [_ask(effects, 5, entry).status_code for entry in (3, 4, 3)] == [202, 202, 202]
    assert effects.wanted() == 3
    effects.put(5, 3, EFFECT)
    assert effects.wanted() == 4
    assert _ask(effects, 5, 3).status_code == 200


def test_an_effect_is_told_as_it_is_drawn(effects):
    effects.put(5, 3, EFFECT)
    told = msgspec.json.decode(_ask(effects, 5, 3).body)
    assert told == {
        "place": [0.85, 0.05, 0.55],
        "with_it": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.5]],
        "without_it": [],
        "field": {
            "axes": [0, 1],
            "lower": [0.8, -0.1],
            "upper": [0.9, 0.2],
            "moved": [[0.01, 0.02], [0.03, 0.04]],
            "known": [[0.01, 0.02], [0.03, 0.04]],
        },
    }


def test_what_is_looked_at_comes_before_what_was_asked_for_earlier(effects):
    for entry in range(KEPT):
        _ask(effects, 5, entry)
    for entry in (7, KEPT):
        assert _ask(effects, 5, entry, b"first=1").status_code == 202
        assert effects.wanted() == entry


def test_of_what_cannot_be_compared_it_is_told_why(effects):
    _ask(effects, 5, 3)
    effects.put(5, 3, Refused("entry 3 cannot be compared: too short"))
    assert effects.wanted() is None
    told = msgspec.json.decode(_ask(effects, 5, 3).body)
    assert told == {"refused": "entry 3 cannot be compared: too short"}


def test_effects_of_another_model_are_gone(effects):
    _ask(effects, 5, 4)
    effects.put(5, 3, EFFECT)
    effects.renew(6)
    assert effects.wanted() is None
    assert _ask(effects, 5, 3).status_code == 204
    effects.put(5, 4, EFFECT)
    assert _ask(effects, 6, 4).status_code == 202


def test_no_more_are_waited_for_or_kept_than_a_page_shows(effects):
    for entry in range(2 * KEPT):
        _ask(effects, 5, entry)
    for entry in range(KEPT + 1):
        effects.put(5, entry, EFFECT)
    assert effects.wanted() is None
    assert _ask(effects, 5, 0).status_code == 202


def test_numbers_that_cannot_be_drawn_are_no_line(effects):
    effects.put(
        5, 3, msgspec.structs.replace(EFFECT, with_it=motion_to_wire([[1e8] * 3] * 2, [[1.0, 0, 0, 0]] * 2, 1.0))
    )
    assert msgspec.json.decode(_ask(effects, 5, 3).body)["with_it"] == []
