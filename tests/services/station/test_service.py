"""The station's shell on the memory bus: what it tells the others of the operator and of the run."""

from dataclasses import replace

import msgspec
import pytest

from protocol import queries, topics
from protocol.messages import (
    AuthorityState,
    Light,
    ModelState,
    ObjectPose,
    OperatorInput,
    Phase,
    Pose,
    RobotState,
    SafetyState,
    SceneState,
)
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.station.service import StationService
from services.station.workflow.state import Settings

POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
REGION = ((0.8, -0.1, 0.5), (0.9, 0.1, 0.5))
SETTINGS = Settings("station-1", "ann", scripted=True)
BY_HAND = Settings("station-1", "ann")


class Tab:
    """Stands in for the browser's page: what it says was pressed and held."""

    def __init__(self):
        self.pressed = []
        self.held = OperatorInput(keys=("KeyE",), focused=True, present=True)
        self.shown = None

    def take_actions(self):
        taken, self.pressed = self.pressed, []
        return taken

    def take_input(self):
        return self.held

    def show(self, view):
        self.shown = view

    def figures(self):
        return ()

    def close(self):
        pass


class Site:
    """A station, and a robot and a model that are there."""

    def __init__(self, page=None, *, settings=SETTINGS):
        self.clock = ManualClock()
        network = MemoryNetwork(self.clock)
        self.other = network.bus()
        self.acquire = self.other.serve(queries.ACQUIRE)
        self.reset = self.other.serve(queries.RESET)
        self.authority = AuthorityState(holder="", epoch=40, expires_in=0.0)
        self.service = StationService(network.bus(), settings, page, seed=3)

    def run(self, seconds):
        for _ in range(round(seconds * self.service.rate_hz)):
            self.clock.advance(1.0 / self.service.rate_hz)
            self.other.publish(topics.ROBOT_STATE, RobotState(measured=POSE, reference=POSE, phase=Phase.IDLE))
            self.other.publish(
                topics.MODEL_STATE, ModelState(kind="adaptive", version=1, demonstrations=1, updates=0, scene="s")
            )
            self.other.publish(topics.AUTHORITY_STATE, self.authority)
            self.service.step(self.clock.now_ns())

    def show_scene(self, **changes):
        scene = SceneState(
            name="s",
            variant="b1",
            boxes=(),
            object_size=(0.05, 0.05, 0.1),
            ellipsoid_radii=(0.05, 0.05, 0.05),
            kicked_over_thresholds=(0.1, 0.1, 0.1),
            start=POSE,
            object_region=REGION,
            variants=("b1", "b2"),
        )
        self.other.publish(topics.SCENE_STATE, msgspec.structs.replace(scene, **changes))

    def grant(self, **scene):
        self.show_scene(**scene)
        self.run(0.1)
        (call,) = self.acquire.take()
        call.reply(queries.AuthorityGranted(41, 1.0))
        self.authority = AuthorityState(holder=call.request.holder, epoch=41, expires_in=1.0)

    def see(self, seconds):
        """Let the object be seen for so long."""
        for _ in range(round(seconds * self.service.rate_hz)):
            self.other.publish(topics.OBJECT_POSE, ObjectPose(pose=POSE, tag=1, pictures=9))
            self.run(1.0 / self.service.rate_hz)


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


def test_nothing_is_asked_of_the_robot_before_a_press_but_the_authority():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    site.grant()
    site.see(10.0)
    assert "Ready. Press Execute." in page.shown.teaching.text
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
