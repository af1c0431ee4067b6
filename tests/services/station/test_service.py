"""The station's shell on the memory bus: what it tells the others of the operator and of the run."""

import msgspec
import pytest

from protocol import queries, topics
from protocol.messages import AuthorityState, Light, Mode, OperatorInput, Person, Phase, Role, SafetyState
from services.bus.stages import Stages
from services.station import service
from services.station.press import Press
from tests.services.station.site import BY_HAND, Site, Tab, spied


def test_the_full_input_state_is_published_in_every_step():
    site = Site(Tab(), settings=BY_HAND)
    held = site.other.subscribe(topics.OPERATOR_INPUT)
    before = site.clock.now_ns()
    site.run(1.0)
    assert held.latest().message.keys == ("KeyE",)
    assert held.latest().message.sequence == 50
    assert site.clock.now_ns() - before == 1_000_000_000


def test_the_page_is_shown_how_old_the_robots_state_is():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    site.run(0.1)
    assert page.shown.robot_age_s == pytest.approx(0.0)


def renewals_of(site, seconds):
    renewals = site.other.subscribe(topics.AUTHORITY_RENEWAL)
    told = []
    for _ in range(round(seconds * site.service.rate_hz)):
        site.run(1.0 / site.service.rate_hz)
        told += [(r.message.operator, r.message.holder, r.message.epoch) for r in renewals.take()]
    return told


def test_the_lease_is_renewed_in_every_step_under_the_epoch_that_was_granted():
    site = Site()
    site.grant()
    site.run(0.1)
    assert renewals_of(site, 1.0) == [("ann", "station-1", 41)] * 50


def test_without_an_operator_nothing_is_renewed():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    site.grant()
    site.run(0.1)
    page.held = OperatorInput(present=False)
    assert renewals_of(site, 1.0) == []
    page.held = OperatorInput(present=True)
    assert len(renewals_of(site, 1.0)) == 50


def test_without_the_authority_nothing_is_renewed_and_no_epoch_is_told():
    site = Site(Tab(), settings=BY_HAND)
    site.grant()
    site.run(0.1)
    site.authority = AuthorityState(holder="station-2", epoch=42, expires_in=1.0)
    site.run(0.1)
    assert renewals_of(site, 1.0) == []
    held = site.other.subscribe(topics.OPERATOR_INPUT)
    site.run(0.1)
    assert (held.latest().message.holder, held.latest().message.epoch) == ("station-1", 0)


@pytest.mark.parametrize("scripted", [True, False])
def test_the_input_says_who_is_there_and_under_which_authority(scripted):
    site = Site() if scripted else Site(Tab(), settings=BY_HAND)
    held = site.other.subscribe(topics.OPERATOR_INPUT)
    site.grant()
    site.run(0.1)
    said = held.latest().message
    assert (said.operator, said.holder, said.epoch, said.present) == ("ann", "station-1", 41, True)


def test_whoever_commands_is_asked_while_the_operator_is_present():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    requests = site.other.subscribe(topics.AUTHORITY_REQUEST)
    site.show_scene()
    site.authority = AuthorityState(operator="bob", holder="station-2", epoch=42, expires_in=1.0)
    site.run(3.0)
    assert requests.take() == []
    page.pressed = ["ask"]
    site.run(1.0)
    said = [received.message for received in requests.take()]
    assert len(said) == topics.AUTHORITY_REQUEST.kept
    assert {(message.operator, message.holder) for message in said} == {("ann", "station-1")}
    page.held = OperatorInput(present=False)
    site.run(1.0)
    assert requests.take() == []


@pytest.mark.parametrize(("action", "give"), [("give_authority", True), ("keep_authority", False)])
def test_who_has_the_input_answers_who_asks_for_the_robot(action, give):
    page = Tab()
    site = Site(page, settings=BY_HAND)
    answers = site.other.serve(queries.ANSWER)
    site.grant()
    site.run(0.1)
    site.authority = msgspec.structs.replace(site.authority, asked=77, asked_by="bob", asked_left=9.0)
    site.run(0.1)
    page.pressed = [action]
    site.run(0.1)
    (call,) = answers.take()
    assert (call.request.number, call.request.epoch, call.request.give) == (77, 41, give)


def test_whoever_has_the_input_asks_for_the_authority_anew_in_their_own_name():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    site.grant()
    site.run(0.1)
    page.held = OperatorInput(operator="carl", present=True)
    site.authority = msgspec.structs.replace(site.authority, operator="ann")
    site.run(0.1)
    (call,) = site.acquire.take()
    assert (call.request.operator, call.request.take_over) == ("carl", False)
    assert "carl has the input now." in page.shown.teaching.told


def test_an_empty_seat_is_still_its_last_operator_s():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    held = site.other.subscribe(topics.OPERATOR_INPUT)
    for operator in ("carl", ""):
        page.held = OperatorInput(operator=operator)
        site.run(0.1)
        assert held.latest().message.operator == "carl"


@pytest.mark.parametrize("page", [Tab(), None], ids=["by hand", "scripted"])
def test_everybody_is_told_who_is_at_the_page(page):
    site = Site(page, settings=BY_HAND) if page else Site()
    told = site.other.subscribe(topics.ATTENDANCE)
    site.run(0.5)
    assert len(told.take()) == 5
    attendance = told.latest().message
    assert (attendance.holder, attendance.people) == ("station-1", (Person("ann", Role.OPERATOR, has_input=True),))
    if page:
        assert page.shown.attendances == (attendance,)


def test_a_stop_carries_the_name_of_who_pressed_it():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    stops = site.other.subscribe(topics.EMERGENCY_STOP)
    for by, told in (("eve", "eve"), ("", "ann")):
        page.pressed = [Press("stop", by=by)]
        site.run(0.02)
        assert stops.latest().message.by == told


def test_a_supervisor_s_revocation_goes_to_the_robot_and_what_it_refuses_is_told():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    revocations = site.other.serve(queries.REVOKE)
    page.pressed = [Press("revoke", "it is late", "eve")]
    site.run(0.02)
    (call,) = revocations.take()
    assert (call.request.by, call.request.reason) == ("eve", "it is late")
    call.reply(queries.Refused("nobody holds the authority"))
    site.run(0.1)
    assert page.shown.notice == "Not revoked: nobody holds the authority."


def test_nothing_is_asked_of_the_robot_before_a_press_but_the_authority():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    site.grant()
    site.see(10.0)
    assert page.shown.teaching.text == "Ready. Watch what the robot does alone."
    assert site.reset.take() == []
    page.pressed = ["execute"]
    site.run(0.1)
    assert len(site.reset.take()) == 1


def test_an_answer_is_taken_once_though_a_stop_comes_between():
    """The grant arrives while a stop is latched, which the station stands under: after the release it asks again."""
    site = Site(Tab(), settings=BY_HAND)
    site.show_scene()
    site.run(0.1)
    (call,) = site.acquire.take()
    site.other.publish(topics.SAFETY_STATE, SafetyState(emergency_stop=True, by="bob"))
    site.run(0.1)
    call.reply(queries.AuthorityGranted(41, 1.0))
    site.run(0.1)
    site.other.publish(topics.SAFETY_STATE, SafetyState(emergency_stop=False, released_by="bob"))
    site.run(0.1)
    (call,) = site.acquire.take()
    call.reply(queries.AuthorityGranted(42, 1.0))
    site.authority = AuthorityState(holder="station-1", epoch=42, expires_in=1.0)
    site.run(0.1)
    assert len(renewals_of(site, 0.2)) == 10


def test_a_stop_goes_before_everything_else_in_its_step():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    told = []
    publish = site.service._bus.publish
    site.service._bus.publish = lambda topic, message: (told.append(topic), publish(topic, message))
    page.pressed = ["stop"]
    site.run(1.0 / site.service.rate_hz)
    assert told[0] is topics.EMERGENCY_STOP
    assert "STOP sent, not confirmed yet." in page.shown.teaching.text
    assert page.shown.teaching.light is Light.RED


def test_a_stop_is_said_on_while_the_robot_moves_and_no_more_once_its_release_was_pressed():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    stops = site.other.subscribe(topics.EMERGENCY_STOP)
    page.pressed = ["stop"]
    site.run(0.1)
    site.other.publish(topics.SAFETY_STATE, SafetyState(emergency_stop=True, by="ann", standing=False))
    stops.take()
    site.run(0.2)
    assert len(stops.take()) == round(0.2 * topics.EMERGENCY_STOP.rate_hz)
    page.pressed = ["release_stop"]
    site.run(1.0)
    assert stops.take() == []


def test_a_question_is_waited_for_five_seconds_and_its_number_is_nobody_elses(monkeypatch):
    site = Site(Tab(), settings=BY_HAND)
    asked = spied(site.service._bus, "ask", monkeypatch)
    site.show_scene()
    site.run(0.1)
    ((_, request, timeout_s),) = [question for question in asked if question[0] is queries.ACQUIRE]
    assert timeout_s == 5.0
    assert request.request > 2**20


@pytest.mark.parametrize(("key", "steers"), [("KeyE", True), ("KeyR", True), ("F13", False)])
def test_the_workflow_sees_whether_a_key_is_held_that_steers(key, steers, monkeypatch):
    page = Tab()
    page.held = OperatorInput(keys=(key,), focused=True, present=True)
    seen = spied(service, "advance", monkeypatch)
    Site(page, settings=BY_HAND).run(0.02)
    ((_, view, _),) = seen
    assert view.steering is steers


def test_what_is_pressed_of_the_gripper_is_said_in_every_step_and_shown():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    held = site.other.subscribe(topics.OPERATOR_INPUT)
    site.grant(wide_open=0.08)
    refining = {"phase": Phase.EXECUTE, "mode": Mode.REFINE, "episode": 1, "opening_reference": 0.08}
    site.robot = msgspec.structs.replace(site.robot, **refining)
    site.run(0.1)
    assert held.latest().message.opening is None
    page.pressed = [Press("grip")]
    site.run(0.3)
    assert held.latest().message.opening == 0.0
    assert (page.shown.wide_open, page.shown.opening) == (0.08, 0.0)


def test_the_page_tells_the_way_from_hand_to_eye_of_who_commands():
    page = Tab()
    page.held = msgspec.structs.replace(page.held, drawn=0.03)
    site = Site(page, settings=BY_HAND)
    site.applied_latency = 0.5
    site.run(0.1)
    assert page.shown.path.known == (0.03,), "whoever does not command is not applied"
    site.grant()
    site.run(0.1)
    assert page.shown.path == Stages(way=0.4, apply=pytest.approx(0.1), picture=0.03)
    assert site.service.figures()[-1].name == "stage_picture"


def test_a_browser_that_draws_no_h264_is_heard_by_the_cameras():
    page = Tab()
    site = Site(page)
    told = site.other.subscribe(topics.PICTURE_QUEUE)
    site.run(0.5)
    assert not told.latest().message.jpeg_only
    page.jpeg_only = True
    site.run(0.5)
    assert told.latest().message.jpeg_only
