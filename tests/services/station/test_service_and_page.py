"""The station's shell on the memory bus: what it does for its page, and for the device in the operator's hand."""

from dataclasses import replace

import pytest

from protocol import queries, topics
from protocol.messages import MasterState
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.process.config import Configuration, StationSection
from services.process.exceptions import UnusableSetting
from services.station import service
from services.station.workflow.action import Action
from tests.services.station.site import BY_HAND, REGION, SETTINGS, Site, Tab, spied


def place(site, page, action):
    """Where the presses' reset is to put the object, which is refused until the operator is asked again."""
    page.pressed = [action]
    asked = set()
    for _ in range(5):
        site.run(0.6)
        (call,) = site.reset.take()
        asked.add(call.request.object_position)
        call.reply(queries.Refused("not yet"))
    site.run(0.1)
    (position,) = asked
    return position


def places(*actions):
    page = Tab()
    site = Site(page, settings=BY_HAND)
    site.grant()
    site.see(2.0)
    return [place(site, page, action) for action in actions]


def test_the_places_of_a_seed_do_not_depend_on_how_often_each_is_tried():
    first, second = places("next", "next")
    assert first != second
    assert places("next", "execute", "next") == [first, first, second]


def test_the_page_tells_whether_the_authority_is_its_own():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    site.grant()
    assert not page.shown.authority_is_mine
    site.run(0.1)
    assert page.shown.authority_is_mine


def test_what_the_page_measured_is_told():
    page = Tab()
    assert Site(page, settings=BY_HAND).service.figures() == page.figures()
    assert Site().service.figures() == ()


@pytest.mark.parametrize("scripted", [True, False])
def test_a_person_s_station_opens_its_page_and_a_script_s_has_none(scripted, monkeypatch):
    started = []

    class Served(Tab):
        def __init__(self, *_, **__):
            super().__init__()

        def start(self):
            started.append(self)

    monkeypatch.setattr("services.station.opening.Page", Served)
    clock = ManualClock()
    section = StationSection(scripted=scripted)
    station = service.build(MemoryNetwork(clock).bus(), clock, Configuration(station=section))
    station.step(clock.now_ns())
    assert [page.shown is not None for page in started] == ([] if scripted else [True])


def test_the_page_is_closed_with_the_station():
    page = Tab()
    Site(page, settings=BY_HAND).service.close()
    assert page.closed
    Site().service.close()


def test_the_object_is_put_into_its_region_and_the_scene_into_the_changed_variant():
    site = Site()
    site.grant()
    site.see(2.0)
    (call,) = site.reset.take()
    assert call.request.variant == "b2"
    assert all(
        low <= value <= high
        for low, value, high in zip(REGION[0], call.request.object_position, REGION[1], strict=True)
    )


def test_a_condition_is_drawn_from_its_own_region_and_the_configured_variant_is_taught():
    site = Site(settings=replace(SETTINGS, variant="b1"))
    site.grant(condition=(0.0, 0.0), condition_region=((-0.1, 0.2), (0.1, 0.3)))
    site.run(0.2)
    (call,) = site.reset.take()
    assert (call.request.variant, call.request.object_position) == ("b1", None)
    first, second = call.request.condition
    assert -0.1 <= first <= 0.1
    assert 0.2 <= second <= 0.3


def test_the_teaching_state_says_who_is_missing():
    site = Site()
    teaching = site.other.subscribe(topics.TEACHING_STATE)
    site.run(0.2)
    assert "Waiting for the robot" in teaching.latest().message.text


def test_a_button_of_the_operators_device_is_one_press_while_it_is_held(monkeypatch):
    seen = spied(service, "advance", monkeypatch)
    site = Site(Tab(), settings=BY_HAND)

    def say(*actions, holder="station-1"):
        site.other.publish(topics.MASTER_STATE, MasterState(holder=holder, actions=actions))
        site.run(0.02)
        return seen[-1][1].actions

    assert say("finish") == frozenset()
    assert say() == frozenset()
    assert say("finish") == {Action.FINISH}
    assert say("finish") == frozenset()
    assert say("finish", holder="station-2") == frozenset()
    assert say("finish") == frozenset()


def test_the_stop_on_a_device_stops(monkeypatch):
    site = Site(Tab(), settings=BY_HAND)
    stops = site.other.subscribe(topics.EMERGENCY_STOP)
    site.run(0.02)
    for actions in ((), ("stop",)):
        site.other.publish(topics.MASTER_STATE, MasterState(holder="station-1", actions=actions))
        site.run(0.02)
    assert stops.latest().message.pressed


def test_the_page_is_told_what_the_device_says_of_itself():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    site.other.publish(topics.MASTER_STATE, MasterState(device="gamepad"))
    site.run(0.02)
    assert page.shown.master.device == "gamepad"


def test_a_language_without_words_is_one_line_that_names_the_setting():
    clock, configuration = ManualClock(), Configuration(station=StationSection(language="xx"))
    with pytest.raises(UnusableSetting, match=r"^\[station\] language: there are no words in 'xx', only in de, en$"):
        service.build(MemoryNetwork(clock).bus(), clock, configuration)
