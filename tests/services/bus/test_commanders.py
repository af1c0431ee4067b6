"""Which robots there are and who commands each: told to whoever comes late too, through losses of the link."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.commander import commander_key, told
from protocol.exceptions import InvalidName
from protocol.names import is_name
from tests.services.bus.late import Late
from tests.system.harness import eventually

WITHIN_S = 20.0
NAMES = st.from_regex(r"[A-Za-z0-9][A-Za-z0-9_-]{0,20}", fullmatch=True)


def become(station, expected):
    eventually(lambda: station.neighbours() == expected, WITHIN_S, lambda: f"{expected} from {station.neighbours()}")


@pytest.mark.zenoh
def test_a_station_knows_all_other_robots_and_who_commands_each_whenever_it_looks_first(join):
    kitchen, garage, station = join("kitchen", "robot"), join("garage", "robot"), join("kitchen", "station-ann")
    kitchen.tell_commander("ann")
    garage.tell_commander("")
    become(station, {"garage": ""})
    garage.tell_commander("ann")
    become(station, {"garage": "ann"})
    garage.tell_commander("bob")
    become(station, {"garage": "bob"})
    late = join("attic", "station-eve")
    become(late, {"garage": "bob", "kitchen": "ann"})


@pytest.mark.zenoh
def test_a_robot_that_has_gone_is_as_it_was_told_last(join):
    garage, station = join("garage", "robot"), join("kitchen", "station-ann")
    garage.tell_commander("ann")
    become(station, {"garage": "ann"})
    garage.close()
    attic = join("attic", "robot")
    attic.tell_commander("")
    become(station, {"garage": "ann", "attic": ""})
    become(join("cellar", "station-eve"), {"attic": ""})


@pytest.mark.zenoh
@pytest.mark.usefixtures("soon")
def test_who_commands_is_told_after_a_cut_as_it_has_become_meanwhile(join, router):
    way = Late(router, 0.0)
    garage, station = join("garage", "robot", way.endpoint), join("kitchen", "station-ann")
    garage.tell_commander("ann")
    become(station, {"garage": "ann"})
    way.cut()
    garage.tell_commander("bob")
    become(station, {"garage": "bob"})
    garage.tell_commander("")
    become(station, {"garage": ""})
    way.close()


@given(NAMES, st.one_of(NAMES, st.text(max_size=30)))
def test_a_key_says_who_commands_and_nobody_whose_name_cannot_stand_in_it(robot, operator):
    assert told(commander_key(robot, operator)) == (robot, operator if is_name(operator) else "")


@pytest.mark.parametrize("key", ["", "retouch/@v0/kitchen/commander", "retouch/@v1/kitchen/alive/robot", "a/b/c/d/e"])
def test_another_key_is_none(key):
    with pytest.raises(InvalidName):
        told(key)
