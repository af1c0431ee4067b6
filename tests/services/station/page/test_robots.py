"""The strip of the other robots: what is known of each is said, and each has a stop."""

import pytest
from views import shown

from protocol.messages import Light, SafetyState
from services.station.neighbours import NEIGHBOURS_KEPT, Neighbour
from services.station.page.robots import robots

READY = SafetyState(emergency_stop=False)
GARAGE = Neighbour("garage", Light.GREEN, "bob", READY, stopping=False, page="http://127.0.0.1:8081/")


def told(*neighbours):
    return robots(shown(neighbours=neighbours))


def test_where_there_is_no_other_robot_there_is_no_strip():
    values = told()
    assert values["robots@hidden"] is True
    assert all(values[f"robot-{slot}@hidden"] is True for slot in range(NEIGHBOURS_KEPT))


def test_another_robot_has_its_light_who_commands_it_its_page_and_its_stop():
    values = told(GARAGE)
    assert (values["robots@hidden"], values["robot-0@hidden"], values["robot-1@hidden"]) == (False, False, True)
    assert (values["robot-0-name"], values["robot-0-text"]) == ("garage", "bob commands")
    assert (values["robot-0@data-light"], values["robot-0-light"]) == ("green", "under way")
    assert values["robot-0-name@data-address"] == "http://127.0.0.1:8081/"
    assert values["robot-0-stop@data-argument"] == "garage"
    assert values["robot-0-stop@aria-label"] == "Stop robot garage: Stop"


@pytest.mark.parametrize(
    ("stopping", "safety", "state", "words"),
    [
        (False, READY, "ready", "Stop"),
        (True, READY, "unconfirmed", "Stop not confirmed"),
        (True, None, "unconfirmed", "Stop not confirmed"),
        (True, SafetyState(emergency_stop=True, standing=False), "moving", "Latched, still moves"),
        (False, SafetyState(emergency_stop=True, standing=True), "stopped", "Stopped"),
    ],
)
def test_its_stop_says_what_the_robot_itself_says_of_it(stopping, safety, state, words):
    values = told(Neighbour("garage", None, "", safety, stopping=stopping, page=""))
    assert (values["robot-0@data-stop"], values["robot-0-stop"]) == (state, words)


def test_a_robot_that_is_not_heard_is_not_spoken_for():
    values = told(Neighbour("garage", Light.GREEN, "bob", None, stopping=False, page=""))
    assert (values["robot-0@data-light"], values["robot-0-text"]) == ("unheard", "not heard now")
