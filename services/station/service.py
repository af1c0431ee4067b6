"""The station process' shell: the workflow's eyes, hands and voice, and the page where there is one."""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Iterable
from dataclasses import replace

import msgspec

from protocol import messages, topics
from protocol.keys import STEERING
from protocol.messages import Figure, OperatorInput
from services.accounts.policy import page_is_open
from services.bus.bus import Bus
from services.bus.identity import new_number
from services.certificates.credentials import is_open
from services.process.clock import Clock
from services.process.config import Configuration
from services.process.exceptions import UnusableSetting
from services.process.robots import camera_names
from services.process.schedule import Schedule
from services.station.company import Company
from services.station.device_buttons import DeviceButtons
from services.station.draw import Draw
from services.station.ears import Ears, came_s, message, prediction_of, young
from services.station.frontend import Frontend
from services.station.gripper import Gripper
from services.station.handover import GIVE, KEEP, HandOver
from services.station.history import HistoryReader
from services.station.live_view.stage import Stage
from services.station.neighbours import Neighbours
from services.station.own_path import OwnPath
from services.station.page.view import PageView
from services.station.press import REVOKE, STOP, Press
from services.station.questions import Questions
from services.station.settings import settings
from services.station.stop import StopButton
from services.station.words.table import speech
from services.station.workflow.action import Action
from services.station.workflow.settings import Settings
from services.station.workflow.state import Phase, Workflow
from services.station.workflow.view import View
from services.station.workflow.words import teaching_state
from services.station.workflow.workflow import advance
from sim.robots.robot import USUAL_CAMERAS

log = logging.getLogger(__name__)


def build(bus: Bus, clock: Clock, configuration: Configuration) -> StationService:
    """The service, its page started where a person is to use it.

    Raises:
        UnusableSetting: there are no words in the language, or the certificate cannot be used.
        Unsecured: others reach the page, and it has no certificate.
        AccountError: they reach it, and nobody has an account.
        PortInUse: the page cannot be served.
    """
    section = configuration.station
    try:
        speech.speak(section.language)
    except LookupError as error:
        raise UnusableSetting("[station] language", str(error)) from None
    page = None if section.scripted else _open_page(configuration, clock)
    told = is_open(configuration) or (page is not None and page_is_open(configuration))
    chosen, cameras = settings(section, configuration.operator), camera_names(configuration)
    return StationService(bus, chosen, page, configuration.seed, open_network=told, cameras=cameras)


def _open_page(configuration: Configuration, clock: Clock) -> Frontend:
    # A scripted station starts without the page's packages, which take a second to load.
    from services.station.opening import open_page  # noqa: PLC0415

    return open_page(configuration, clock)


class StationService:
    """Runs the workflow, holds the authority's lease, publishes what the operator does.

    Args:
        bus: to the other processes.
        workflow_settings: of the run.
        page: the operator's; None where the workflow is scripted.
        seed: of the places.
        open_network: others can listen in on it, and command on it.
        cameras: their names.
    """

    rate_hz = topics.OPERATOR_INPUT.rate_hz

    def __init__(
        self,
        bus: Bus,
        workflow_settings: Settings,
        page: Frontend | None,
        seed: int,
        *,
        open_network: bool = False,
        cameras: Iterable[str] = USUAL_CAMERAS,
    ) -> None:
        self._bus = bus
        self._settings = workflow_settings
        self._page = page
        self._open_network = open_network
        self._draw = Draw(workflow_settings.place, seed)
        self._ears = Ears(bus, cameras)
        self._path = OwnPath(self._ears, bus.identity, workflow_settings.holder)
        self._stop = StopButton(bus, self._ears.safety, workflow_settings.holder)
        self._hand_over = HandOver(bus, workflow_settings.holder)
        self._company = Company(bus)
        self._neighbours = Neighbours(bus, workflow_settings.holder) if page is not None else None
        self._stage = Stage(self._ears)
        self._history = HistoryReader(bus, page.effects) if page is not None else None
        self._buttons = DeviceButtons(self._ears.master, workflow_settings.holder)
        self._gripper = Gripper(workflow_settings.holder)
        self._workflow = Workflow()
        self._questions = Questions(bus)
        self._schedule = Schedule()
        self._worded: Phase | None = None
        self._words = PageView()
        self._never = threading.Event()

    @property
    def call(self) -> threading.Event:
        """Set where something was pressed or let go at the page."""
        return self._page.call if self._page is not None else self._never

    def step_early(self, now_ns: int) -> None:
        """What a person does acts at once; what comes of it is told in the next step."""
        self._act(now_ns)

    def step(self, now_ns: int) -> None:
        """A stop before all; then look, advance the workflow, ask, tell."""
        self._tell(now_ns, self._act(now_ns))

    def _act(self, now_ns: int) -> View:
        pressed = self._page.take_presses() if self._page is not None else []
        pressed += self._buttons.take(now_ns)
        self._press_stop(now_ns, pressed)
        held = self._page.take_input() if self._page is not None else OperatorInput(present=True)
        if held.operator:
            self._settings = replace(self._settings, operator=held.operator)
        view = self._view(now_ns, pressed, held)
        self._gripper.hear(pressed, view)
        before = self._workflow.phase
        step = advance(self._workflow, view, self._settings)
        self._workflow = step.state
        if step.ask is not None:
            self._questions.ask(step.ask)
        if before is not step.state.phase:
            log.debug("%s -> %s", before.value, step.state.phase.value)
            if step.state.phase is Phase.RESETTING and step.state.placed is None:
                self._draw.taken()
        self._publish(self._path.seen(held), now_ns)
        self._pass_authority(now_ns, pressed, view)
        self._company.tell(self._attendance(), now_ns)
        return view

    def _tell(self, now_ns: int, view: View) -> None:
        """What moves is shown in every step; words are put together as often as they are told, or where it goes on."""
        self._ears.queue.step(now_ns, jpeg_only=self._page is not None and self._page.jpeg_only)
        told = self._schedule.due(topics.TEACHING_STATE, now_ns)
        if told or (self._page is not None and self._workflow.phase is not self._worded):
            self._worded = self._workflow.phase
            teaching = teaching_state(self._workflow, view, self._settings)
            if told:
                self._bus.publish(topics.TEACHING_STATE, teaching)
            if self._page is not None:
                self._words = self._page_words(now_ns, view, teaching)
        if self._history is not None:
            self._history.step(now_ns, view.model)
        if self._page is not None:
            self._page.show(self._page_view(now_ns, view))

    def figures(self) -> tuple[Figure, ...]:
        """Of the page, and how old its pictures are when they have been drawn."""
        return (*self._page.figures(), *self._path.figures()) if self._page is not None else ()

    def close(self) -> None:
        """Close the page."""
        if self._page is not None:
            self._page.close()

    def _press_stop(self, now_ns: int, pressed: list[Press]) -> None:
        actions = {press.action for press in pressed}
        if Action.RELEASE_STOP.value in actions:
            self._stop.let_go(now_ns)
        for press in pressed:
            by = press.by or self._settings.operator
            if press.action == STOP:
                self._stop.press(now_ns, by)
            if self._neighbours is not None:
                self._neighbours.hear(press, by, now_ns)
        self._stop.step(now_ns)
        if self._neighbours is not None:
            self._neighbours.step(now_ns)

    def _pass_authority(self, now_ns: int, pressed: list[Press], view: View) -> None:
        """Ask for the authority that another station has, answer who asks this one for it, or end whoever's it is."""
        for press in pressed:
            if press.action in (GIVE, KEEP):
                self._hand_over.answer(view.authority, give=press.action == GIVE)
            elif press.action == REVOKE:
                self._hand_over.revoke(press.by, press.argument, now_ns)
        if self._workflow.asks and view.present:
            self._hand_over.ask(self._workflow.asks, self._settings.operator, now_ns)

    def _attendance(self) -> messages.Attendance:
        if self._page is None:
            script = messages.Person(self._settings.operator, messages.Role.OPERATOR, has_input=True)
            return messages.Attendance(holder=self._settings.holder, people=(script,))
        return msgspec.structs.replace(self._page.attendance(), holder=self._settings.holder)

    def _view(self, now_ns: int, pressed: list[Press], held: OperatorInput) -> View:
        ears = self._ears
        arrangement = ears.scene.latest()
        scene = message(arrangement)
        return View(
            now_s=now_ns / 1e9,
            number=new_number(),  # what outlived an earlier station is not taken for this one's
            present=held.present,
            steering=not STEERING.isdisjoint(held.keys),
            stopping=self._stop.unconfirmed,
            robot=young(ears.robot.latest(), now_ns),
            authority=ears.authority.fresh(now_ns),
            safety=ears.safety.fresh(now_ns),
            verdict=ears.verdict.fresh(now_ns),
            execution=ears.execution.fresh(now_ns),
            scene=scene,
            scene_s=came_s(arrangement),
            model=ears.model.fresh(now_ns),
            seen=ears.seen.fresh(now_ns),
            seen_s=came_s(ears.seen.latest()),
            result=message(ears.results.latest()),
            answer=self._questions.answer(),
            presses=tuple(pressed),
            drawn=self._draw.of(scene),
            kept_at=self._history.kept_at if self._history is not None else (),
        )

    def _publish(self, held: OperatorInput, now_ns: int) -> None:
        """Who is here and what is held; that s/he is present, where this station holds the authority."""
        operator, holder, epoch = self._settings.operator, self._settings.holder, self._workflow.held_epoch
        blind = self._page is not None and self._ears.blind(now_ns)  # a script looks at no pictures
        who = {"operator": operator, "holder": holder, "epoch": epoch}
        said = msgspec.structs.replace(held, **who, blind=blind, opening=self._gripper.asked)
        self._bus.publish(topics.OPERATOR_INPUT, said)
        if epoch and held.present:
            renewal = messages.AuthorityRenewal(operator=operator, holder=holder, epoch=epoch)
            self._bus.publish(topics.AUTHORITY_RENEWAL, renewal)

    def _page_words(self, now_ns: int, view: View, teaching: messages.TeachingState) -> PageView:
        """What the page shows, what moves aside."""
        ears, workflow = self._ears, self._workflow
        mine = view.authority is not None and view.authority.holder == self._settings.holder
        return PageView(
            teaching=teaching,
            verdict=message(ears.verdict.latest()),
            authority=view.authority,
            authority_is_mine=mine,
            neighbours=self._neighbours.there(now_ns) if self._neighbours is not None else (),
            attendances=self._company.there(now_ns),
            notice=self._hand_over.fault(now_ns),
            open_network=self._open_network,
            model=view.model,
            prediction=prediction_of(workflow.prediction, view.model),
            history=self._history.rows if self._history is not None else None,
            skills=self._history.skills.listed if self._history is not None else None,
            execution=view.execution,
            spoilt=self._stage.spoilt(now_ns),
            drawing=self._stage.drawing(now_ns, workflow.approach.waypoints),
            master=ears.master.fresh(now_ns),
            recording=message(ears.recording.latest()),
            wide_open=view.scene.wide_open if view.scene is not None else 0.0,
            opening=self._gripper.asked,
        )

    def _page_view(self, now_ns: int, view: View) -> PageView:
        """What the page shows now."""
        ears, robot = self._ears, self._ears.robot.latest()
        return replace(
            self._words,
            safety=view.safety,
            robot=message(robot),
            robot_age_s=robot.age_s(now_ns) if robot is not None else math.inf,
            path=self._path.stages(view.authority, view.robot, now_ns),
            object_pose=message(ears.seen.latest()),
            force=self._stage.force(now_ns),
            cameras={name: self._path.picture(camera, now_ns) for name, camera in ears.cameras.items()},
            cloud=self._path.picture(ears.cloud, now_ns),
        )
