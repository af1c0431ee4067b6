"""Every page lists by name who commands, who else may, who watches and who supervises, at every station."""

from dataclasses import replace

import pytest
from views import SEATED, shown

from protocol.messages import Attendance, AuthorityState, Person, Role
from services.station.page.identity import Identity
from services.station.page.people import GROUPS, people

ANN = Person("ann", Role.OPERATOR, has_input=True)
BOB = Person("bob", Role.OPERATOR)
CARL = Person("carl", Role.OBSERVER)
EVE = Person("eve", Role.SUPERVISOR)
ZOE = Person("zoë", Role.OPERATOR, has_input=True)
HERE = Attendance(holder="station-1", people=(ANN, BOB, CARL))
THERE = Attendance(holder="station-2", people=(ZOE, EVE))
AUTHORITY = AuthorityState(operator="ann", holder="station-1", epoch=1, expires_in=1.0)
AS_ANN = replace(SEATED, identity=Identity("ann", Role.OPERATOR))


def told(standing=AS_ANN, *, authority=AUTHORITY, attendances=(HERE, THERE)):
    return people(shown(authority=authority, attendances=attendances), standing)


def listed(values):
    return tuple(values[f"people-{group}"] for group in GROUPS)


def test_everybody_is_listed_at_each_station():
    assert listed(told()) == ("ann", "bob, zoë", "carl", "eve")


def test_who_has_the_input_of_a_station_that_does_not_command_is_a_second_operator():
    assert listed(told(authority=None)) == ("", "ann, bob, zoë", "carl", "eve")


def test_a_group_that_nobody_is_in_is_not_shown():
    values = told(attendances=(HERE,))
    assert [values[f"people-{group}-row@hidden"] for group in GROUPS] == [False, False, False, True]


def test_who_commands_sees_at_a_glance_who_else_is_there():
    assert told()["who-others"] == "bob could operate, carl watches, zoë could operate, eve supervises"


@pytest.mark.parametrize(("person", "others"), [(CARL, "bob could operate"), (BOB, "carl watches")])
def test_nobody_is_told_of_themselves(person, others):
    standing = replace(SEATED, armed=False, identity=Identity(person.name, person.role))
    assert told(standing, attendances=(HERE,))["who-others"] == others


def test_who_gave_no_name_is_somebody():
    values = told(attendances=(Attendance(holder="station-1", people=(Person("", Role.OBSERVER),)),))
    assert (values["people-watching"], values["who-others"]) == ("somebody", "somebody watches")


@pytest.mark.parametrize(
    ("role", "words"),
    [
        (Role.OPERATOR, "Here as ann, to operate"),
        (Role.OBSERVER, "Watching as ann"),
        (Role.SUPERVISOR, "Supervising as ann"),
    ],
)
def test_a_tab_says_as_whom_it_is_there_and_what_is_wrong_with_that(role, words):
    values = told(replace(SEATED, identity=Identity("ann", role, "That is no name.")))
    assert (values["who-you"], values["who-fault"]) == (words, "That is no name.")
