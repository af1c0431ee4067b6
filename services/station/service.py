"""The station process' shell: the workflow's eyes, hands and voice, and the page where there is one."""

from __future__ import annotations

import logging
import secrets
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np

from protocol import messages, topics
from protocol.messages import Figure, OperatorInput
from services.bus.arrays import vector3
from services.bus.bus import Bus, Pending
from services.bus.subscription import Received, Subscription
from services.process.clock import Clock
from services.process.config import Configuration, StationSection
from services.station.page.view import PageView, Picture
from services.station.workflow.state import Action, Phase, Place, Settings, View, Workflow
from services.station.workflow.words import teaching_state
from services.station.workflow.workflow import advance

if TYPE_CHECKING:
    from services.station.page.page import Page

log = logging.getLogger(__name__)

QUERY_TIMEOUT_S = 5.0
STOP = "stop"
STOP_REPEATS = 10
"""A stop is sent for a second, at the topic's rate: what is lost on the way is sent again."""


def build(bus: Bus, clock: Clock, configuration: Configuration) -> StationService:
    """The service, its page started where a person is to use it.

    Raises:
        ServiceError: the page cannot be served.
    """
    section = configuration.station
    page = None if section.scripted else _open_page(section, configuration.name, clock)
    return StationService(bus, clock, settings(section, configuration.operator), page, configuration.seed)


def _open_page(section: StationSection, robot: str, clock: Clock) -> Page:
    # A scripted station starts without the page's packages, which take a second to load.
    from services.station.page.page import Page  # noqa: PLC0415

    page = Page(section, robot, clock)
    page.start()
    return page


def settings(section: StationSection, operator: str) -> Settings:
    """The workflow's settings as configured."""
    return Settings(
        # A station that was restarted is another one: the robot ends what it does not know of.
        holder=f"station-{secrets.token_hex(2)}",
        operator=operator,
        autonomous_s=section.autonomous_s,
        refine_s=section.refine_s,
        refinements_allowed=section.refinements_allowed,
        updates_allowed=section.updates_allowed,
        adapt=section.adapt,
        alpha=section.alpha,
        variant=section.variant,
        scripted=section.scripted,
        once=section.once,
    )


class Ears:
    """What the station subscribes to."""

    def __init__(self, bus: Bus) -> None:
        self.robot = bus.subscribe(topics.ROBOT_STATE)
        self.authority = bus.subscribe(topics.AUTHORITY_STATE)
        self.safety = bus.subscribe(topics.SAFETY_STATE)
        self.scene = bus.subscribe(topics.SCENE_STATE)
        self.model = bus.subscribe(topics.MODEL_STATE)
        self.seen = bus.subscribe(topics.OBJECT_POSE)
        self.results = bus.subscribe(topics.EPISODE_RESULT)
        self.verdict = bus.subscribe(topics.VERDICT)
        self.recording = bus.subscribe(topics.RECORDING)
        self.master = bus.subscribe(topics.MASTER_STATE)
        self.head = bus.subscribe(topics.HEAD_IMAGE)
        self.wrist = bus.subscribe(topics.WRIST_IMAGE)


class StationService:
    """Runs the workflow, holds the authority's lease, publishes what the operator does.

    Args:
        bus: to the other processes.
        clock: of the view.
        workflow_settings: of the run.
        page: the operator's; None where the workflow is scripted.
        seed: of the places.
    """

    rate_hz = topics.OPERATOR_INPUT.rate_hz

    def __init__(self, bus: Bus, clock: Clock, workflow_settings: Settings, page: Page | None, seed: int) -> None:
        del clock
        self._bus = bus
        self._settings = workflow_settings
        self._page = page
        self._random = np.random.default_rng(seed)
        self._ears = Ears(bus)
        # Requests are numbered from a random start: a result that outlived an earlier station is not taken for ours.
        self._workflow = Workflow(request=secrets.randbelow(2**40))
        self._pending: Pending[Any] | None = None
        self._pending_phase = Phase.WAITING
        self._drawn: Place | None = None
        self._stops_to_send = 0
        self._ticks = 0

    def step(self, now_ns: int) -> None:
        """Look, advance the workflow, ask, tell."""
        pressed = self._page.take_actions() if self._page is not None else []
        view = self._view(now_ns, pressed)
        before = self._workflow.phase
        step = advance(self._workflow, view, self._settings)
        self._workflow = step.state
        if step.ask is not None:
            self._pending = self._bus.ask(step.ask.query, step.ask.request, QUERY_TIMEOUT_S)
            self._pending_phase = step.state.phase
        if before is not step.state.phase:
            log.debug("%s -> %s", before.value, step.state.phase.value)
            if step.state.phase is Phase.RESETTING and step.state.placed is None:
                self._drawn = None
        self._emergency_stop(STOP in pressed)
        self._publish(view)
        self._bus.publish(topics.OPERATOR_INPUT, self._input())
        if self._page is not None:
            self._page.show(self._page_view(now_ns, view))
        self._ticks += 1

    def figures(self) -> tuple[Figure, ...]:
        """Of the page."""
        return self._page.figures() if self._page is not None else ()

    def close(self) -> None:
        """Close the page."""
        if self._page is not None:
            self._page.close()

    def _view(self, now_ns: int, pressed: list[str]) -> View:
        ears = self._ears
        arrangement = ears.scene.latest()
        scene = _message(arrangement)
        sighting = ears.seen.latest()
        known = {action.value: action for action in Action}
        return View(
            now_s=now_ns / 1e9,
            robot=ears.robot.fresh(now_ns),
            authority=ears.authority.fresh(now_ns),
            safety=ears.safety.fresh(now_ns),
            scene=scene,
            scene_s=arrangement.received_ns / 1e9 if arrangement is not None else 0.0,
            model=ears.model.fresh(now_ns),
            seen=ears.seen.fresh(now_ns),
            seen_s=sighting.received_ns / 1e9 if sighting is not None else 0.0,
            result=_message(ears.results.latest()),
            outcome=self._outcome(),
            actions=frozenset(known[name] for name in pressed if name in known),
            drawn=self._draw(scene),
        )

    def _outcome(self) -> Any:
        """Of the query asked last, once; an answer to a question of a phase that has passed is not one."""
        if self._pending is None or (outcome := self._pending.poll()) is None:
            return None
        self._pending = None
        return outcome if self._pending_phase is self._workflow.phase else None

    def _draw(self, scene: messages.SceneState | None) -> Place | None:
        if scene is not None and self._drawn is None:
            low, high = scene.condition_region if scene.condition else scene.object_region
            drawn = tuple(float(self._random.uniform(a, b)) for a, b in zip(low, high, strict=True))
            self._drawn = Place(condition=drawn) if scene.condition else Place(object_position=vector3(drawn))
        return self._drawn

    def _input(self) -> OperatorInput:
        """What is held on the page, in whose name; a script is always there and holds nothing."""
        held = self._page.take_input() if self._page is not None else OperatorInput(present=True)
        return msgspec.structs.replace(
            held, operator=self._settings.operator, holder=self._settings.holder, epoch=self._workflow.epoch
        )

    def _emergency_stop(self, pressed: bool) -> None:
        if pressed:
            self._stops_to_send = STOP_REPEATS
        every = round(self.rate_hz / topics.EMERGENCY_STOP.rate_hz)
        if self._stops_to_send and (pressed or self._ticks % every == 0):
            self._stops_to_send -= 1
            message = messages.EmergencyStop(pressed=True, by=self._settings.holder, reason="the operator pressed stop")
            self._bus.publish(topics.EMERGENCY_STOP, message)

    def _publish(self, view: View) -> None:
        if self._ticks % round(self.rate_hz / topics.TEACHING_STATE.rate_hz):
            return
        self._bus.publish(topics.TEACHING_STATE, teaching_state(self._workflow, view, self._settings))
        if self._workflow.epoch and self._workflow.phase is not Phase.FINISHED:
            renewal = messages.AuthorityRenewal(holder=self._settings.holder, epoch=self._workflow.epoch)
            self._bus.publish(topics.AUTHORITY_RENEWAL, renewal)

    def _page_view(self, now_ns: int, view: View) -> PageView:
        ears = self._ears
        robot = ears.robot.latest()
        mine = view.authority is not None and view.authority.holder == self._settings.holder
        base = PageView(
            teaching=teaching_state(self._workflow, view, self._settings),
            verdict=_message(ears.verdict.latest()),
            safety=view.safety,
            authority=view.authority,
            authority_is_mine=mine,
            model=view.model,
            object_pose=_message(ears.seen.latest()),
            recording=_message(ears.recording.latest()),
            head=_picture(ears.head, now_ns),
            wrist=_picture(ears.wrist, now_ns),
            notice=self._workflow.notice,
        )
        if robot is None:
            return base
        latency = robot.message.applied_latency
        figures = (Figure("applied", latency, "s"),) if latency >= 0.0 else ()
        return replace(base, robot=robot.message, robot_age_s=robot.age_s(now_ns), latencies=figures)


def _message(received: Received[Any] | None) -> Any:
    return received.message if received is not None else None


def _picture(camera: Subscription[messages.CameraImage], now_ns: int) -> Picture | None:
    received = camera.latest()
    return Picture(received.message.data, received.age_s(now_ns)) if received is not None else None
