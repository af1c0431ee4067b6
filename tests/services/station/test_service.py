"""The station's shell on the memory bus: what it tells the others of the operator and of the run."""

from dataclasses import replace

import msgspec
import pytest

from protocol import queries, topics
from protocol.messages import AuthorityState, ModelState, OperatorInput, Phase, Pose, RobotState, SceneState
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.station.service import StationService
from services.station.workflow.state import Settings

POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
REGION = ((0.8, -0.1, 0.5), (0.9, 0.1, 0.5))
SETTINGS = Settings("station-1", scripted=True)
BY_HAND = Settings("station-1")


class Tab:
    """Stands in for the browser's page: what it says was pressed and held."""

    def __init__(self):
        self.pressed = []
        self.held = OperatorInput(keys=("KeyE",), focused=True)
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
        self.service = StationService(network.bus(), self.clock, settings, page, seed=3)

    def run(self, seconds):
        for _ in range(round(seconds * self.service.rate_hz)):
            self.clock.advance(1.0 / self.service.rate_hz)
            self.other.publish(topics.ROBOT_STATE, RobotState(measured=POSE, reference=POSE, phase=Phase.IDLE))
            self.other.publish(
                topics.MODEL_STATE, ModelState(kind="adaptive", version=1, demonstrations=1, updates=0, scene="s")
            )
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
        self.other.publish(topics.AUTHORITY_STATE, AuthorityState(holder=call.request.holder, epoch=41, expires_in=1.0))


def test_the_emergency_stop_is_sent_at_once_and_repeated_for_a_second():
    page = Tab()
    site = Site(page, settings=BY_HAND)
    stops = site.other.subscribe(topics.EMERGENCY_STOP)
    page.pressed = ["stop"]
    site.run(1.0 / site.service.rate_hz)
    assert [s.message.pressed for s in stops.take()] == [True]
    site.run(2.0)
    assert len(stops.take()) == 9


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


def test_the_lease_is_renewed_under_the_epoch_that_was_granted():
    site = Site()
    renewals = site.other.subscribe(topics.AUTHORITY_RENEWAL)
    site.grant()
    site.run(1.0)
    assert {(r.message.holder, r.message.epoch) for r in renewals.take()} == {("station-1", 41)}


def test_the_object_is_put_into_its_region_and_the_scene_into_the_changed_variant():
    site = Site()
    site.grant()
    site.run(0.2)
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
