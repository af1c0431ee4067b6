"""An entry of the history in words."""

import msgspec
import pytest
from views import shown, teaching

from protocol.messages import Method, Part, Purpose
from protocol.queries import Entry, HistoryListed
from services.station.page.entries import rows_of
from services.station.page.history import history

CORRECTION = Entry(
    id=7,
    purpose=Purpose.UPDATE,
    method=Method.REFINE,
    operator="anna",
    at="2026-11-27T10:00:00+00:00",
    alpha=1.0,
    part=Part(),
    object_position=(0.85, 0.05, 0.55),
    mean=0.0124,
    most=0.0381,
    in_use=True,
)
FIRST = msgspec.structs.replace(
    CORRECTION, id=1, purpose=Purpose.INITIAL, method=Method.UNKNOWN, operator="", at="", mean=-1.0, most=-1.0
)


def _row(entry=CORRECTION, **changes):
    (row,) = rows_of(HistoryListed(9, (msgspec.structs.replace(entry, **changes),))).rows
    return row


def test_a_correction_says_what_it_is_by_whom_when_how_and_by_how_much():
    row = _row()
    assert (row.id, row.what, row.how, row.who, row.at) == (
        7,
        "Correction 7",
        "while it moved",
        "anna",
        CORRECTION.at,
    )
    assert row.moved == "up to 38 mm, 12 mm on average"
    assert (row.believed, row.in_use, row.turned) == ("", True, "")


def test_of_a_first_demonstration_nothing_is_said_that_is_not_known():
    row = _row(FIRST)
    assert (row.what, row.how, row.who, row.at, row.moved) == ("First demonstration 1", "", "", "", "")


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"alpha": 0.35}, "believed 35 %"),
        ({"part": Part(0.25, 1.0)}, "25 to 100 % of the motion"),
        ({"alpha": 0.0, "part": Part(0.0, 0.5)}, "believed 0 %, 0 to 50 % of the motion"),
    ],
)
def test_how_far_and_of_which_part_it_is_believed_is_said_where_it_is_not_all(changes, words):
    assert _row(**changes).believed == words


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"in_use": False, "turned_by": "ben", "turned_at": "x"}, "taken back by ben"),
        ({"in_use": False}, "taken back"),
        ({"turned_by": "eva", "turned_at": "x"}, "used again by eva"),
        ({"turned_at": "x"}, "used again"),
    ],
)
def test_who_took_it_back_or_wanted_it_back_is_said(changes, words):
    assert _row(**changes).turned == words


def test_the_region_counts_what_is_in_use_and_what_is_not_shown():
    listed = HistoryListed(9, (CORRECTION, msgspec.structs.replace(FIRST, in_use=False)), older=3)
    values = history(shown(teaching=teaching(), history=rows_of(listed)))
    assert values["skill-count"] == "Version 9: 1 of 2 in use"
    assert values["skill-older"] == "3 older ones are not shown"
    assert history(shown(history=rows_of(HistoryListed(0, ()))))["skill-count"] == "Nothing yet"


def test_what_is_taken_back_by_undo_is_called_as_the_list_calls_it():
    newest = msgspec.structs.replace(CORRECTION, id=8, in_use=False)
    values = history(shown(history=rows_of(HistoryListed(9, (newest, CORRECTION, FIRST)))))
    assert values["action-undo@data-confirm"] == "Take back what the robot learnt last, Correction 7?"
    only_first = history(shown(history=rows_of(HistoryListed(1, (FIRST,)))))
    assert only_first["action-undo@data-confirm"] == "Take back what the robot learnt last?"


def test_a_row_can_be_turned_where_the_workflow_offers_it():
    assert history(shown(teaching=teaching()))["history@data-allowed"] == ""
    offered = teaching(actions=("execute", "take_back", "use_again"))
    assert history(shown(teaching=offered))["history@data-allowed"] == "take_back use_again"


def test_the_confidence_is_that_of_the_workflow():
    values = history(shown(teaching=teaching(confidence=0.35)))
    assert (values["confidence@data-share"], values["confidence-share"]) == ("0.35", "35 %")
    assert history(shown())["confidence-share"] == ""
