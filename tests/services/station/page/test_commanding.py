"""The page says who commands: the reader only where the authority is this station's and the input this tab's."""

from dataclasses import replace

import pytest
from views import SEATED, shown

from protocol.messages import AuthorityState
from services.station.page.commanding import commanding

LOOKING_ON = replace(SEATED, armed=False)
BY_ANN = {"operator": "ann", "holder": "station-1", "epoch": 1, "expires_in": 1.0}


def told(standing, *, mine=True, **changes):
    authority = AuthorityState(**(BY_ANN | changes))
    return commanding(shown(authority=authority, authority_is_mine=mine), standing)


@pytest.mark.parametrize(
    ("mine", "standing", "words", "tone"),
    [
        (True, SEATED, "You command", "good"),
        (True, LOOKING_ON, "ann commands", "warn"),
        (False, SEATED, "ann commands", "warn"),
        (False, LOOKING_ON, "ann commands", "warn"),
    ],
)
def test_only_who_has_input_and_authority_is_told_to_command(mine, standing, words, tone):
    values = told(standing, mine=mine)
    assert (values["who-text"], values["who@data-tone"]) == (words, tone)


def test_a_station_whose_person_gave_no_name_is_named():
    assert told(LOOKING_ON, operator="")["who-text"] == "station-1 commands"


@pytest.mark.parametrize("authority", [None, AuthorityState(holder="", epoch=1, expires_in=0.0)])
def test_where_nobody_commands_this_is_said(authority):
    assert commanding(shown(authority=authority), SEATED)["who-text"] == "Nobody commands"


REQUEST = {"asked_by": "bob", "asked": 7, "asked_left": 6.2}


def test_who_commands_is_asked_by_name_and_told_how_long_silence_takes():
    values = told(SEATED, **REQUEST)
    assert values["robot-asked@data-open"] is True
    assert values["robot-asked-text"] == "bob asks for the robot and gets it in 7 s."


@pytest.mark.parametrize(("mine", "standing"), [(False, SEATED), (True, LOOKING_ON)])
def test_nobody_else_is_asked(mine, standing):
    values = told(standing, mine=mine, **REQUEST)
    assert (values["robot-asked@data-open"], values["robot-asked-text"]) == (False, "")


def test_without_a_request_nobody_is_asked():
    assert told(SEATED)["robot-asked@data-open"] is False
