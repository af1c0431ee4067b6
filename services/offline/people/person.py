"""A person at a station's page who teaches: reads what it says, presses what it offers, leads by one device.

They have nothing that a person in front of a screen has not: what the page offers, and the robot as they see it.
"""

from __future__ import annotations

import math
import threading
from dataclasses import dataclass

import numpy as np

from protocol.messages import Attendance, Figure, Mode, OperatorInput, Origin, Phase, RobotState, TeachingState
from protocol.queries import Effect, Refused
from protocol.topics import EXECUTION, OBJECT_POSE, ROBOT_STATE, SCENE_STATE
from services.bus.arrays import motion_from_wire
from services.bus.bus import Bus
from services.bus.predictions import Predictions
from services.offline.people.hands import hand_at
from services.offline.people.ways import Device, Teaching
from services.process.clock import Clock
from services.station.page.view import PageView
from services.station.press import Press
from sim import tasks as scenes
from sim.person.attention import REACTION, Attention
from sim.person.helm import Helm
from sim.person.intention import Intention
from sim.person.itinerary import Itinerary
from sim.person.plans import Outlook
from sim.person.scatter import CAREFUL
from sim.person.sight import Sight
from sim.pose import Pose

CONSIDERS_S = 0.5
"""From where something can be pressed until it is."""

SETTLES_S = 0.3
"""A hand comes to the device after the robot has begun."""

TIMID = 0.6
"""Share of the correction in a first try that is to be corrected further."""


@dataclass(frozen=True)
class Character:
    """Who it is.

    Attributes:
        seed: of all that is not meant.
        scatter: between two ways that they mean alike, while the robot moves [m].
        misjudgement: standard deviation of the error of the depth that they see [m].
        reaction: from seeing to acting on it; with a stylus it is everybody's [s].
        askew: by how much they misjudge the axes of keys, sticks and pads, about the vertical [rad].
        looks_first: they let the robot try what it knows before they teach it.
    """

    seed: int
    scatter: float
    misjudgement: float
    reaction: float = REACTION
    askew: float = 0.0
    looks_first: bool = False


class NoEffects:
    """They look at no entry of the history."""

    def wanted(self) -> int | None:
        """None."""
        return None

    def put(self, version: int, entry: int, effect: Effect | Refused) -> None:
        """Not looked at."""

    def renew(self, version: int) -> None:
        """Not looked at."""


@dataclass(eq=False)
class _Motion:
    """What they do in one motion."""

    episode: int
    helm: Helm
    intention: Intention | None = None
    itinerary: Itinerary | None = None


class Person:
    """Sits at the page. See `Frontend`.

    Args:
        bus: in place of the screen.
        clock: of the process.
        teaching: how they teach.
        device: that they lead by.
        character: who it is.
    """

    def __init__(self, bus: Bus, clock: Clock, teaching: Teaching, device: Device, character: Character) -> None:
        self.effects = NoEffects()
        self.jpeg_only = False
        self.call = threading.Event()
        self.teaching: TeachingState | None = None
        self._clock = clock
        self._how = teaching
        self._who = character
        self._hand = hand_at(device, np.random.default_rng((character.seed, 4)))
        self._rng = np.random.default_rng((character.seed, 3))
        self._of_sight = np.random.default_rng((character.seed, 2))
        self._predictions = Predictions(bus)
        self._robot = bus.subscribe(ROBOT_STATE)
        self._execution = bus.subscribe(EXECUTION)
        self._scene = bus.subscribe(SCENE_STATE)
        self._object = bus.subscribe(OBJECT_POSE)
        self._motion: _Motion | None = None
        self._began: float | None = None
        self._press: list[Press] = []
        self._meant: tuple[Press, float] | None = None
        self._tried = 0
        self._done_at = math.inf

    def show(self, view: PageView) -> None:
        """Read what it says."""
        self.teaching = view.teaching

    def take_input(self) -> OperatorInput:
        """Look at the robot, and lead it."""
        now = self._clock.now_ns() / 1e9
        received = self._robot.fresh(self._clock.now_ns())
        if received is None or received.phase is not Phase.EXECUTE or received.mode is Mode.AUTONOMOUS:
            self._began = None
            self._hand.rest()
        else:
            self._began = now if self._began is None else self._began
            if now - self._began >= SETTLES_S:
                self._lead(received, now)
        if now >= self._done_at:
            self._done_at = math.inf
            self._do("finish", now)
        return self._hand.says(now)

    def take_presses(self) -> list[Press]:
        """What they have decided to press, once they have considered it."""
        now = self._clock.now_ns() / 1e9
        pressed, self._press = self._press, []
        wanted = self._wanted()
        if wanted is None or (self._meant is not None and wanted != self._meant[0]):
            self._meant = None
        if wanted is not None and self._meant is None:
            self._meant = wanted, now
        if self._meant is not None and now - self._meant[1] >= CONSIDERS_S:
            pressed.append(self._meant[0])
            self._meant = None
        return pressed

    def attendance(self) -> Attendance:
        """They are the page's own."""
        return Attendance(holder="")

    def figures(self) -> tuple[Figure, ...]:
        """None."""
        return ()

    def close(self) -> None:
        """Nothing to close."""

    def _wanted(self) -> Press | None:
        """What brings the lesson on, of what the page offers."""
        teaching = self.teaching
        if teaching is None:
            return None
        wanted = self._next(teaching)
        return wanted if wanted is not None and wanted.action in teaching.actions else None

    def _next(self, teaching: TeachingState) -> Press | None:
        if "go_on" in teaching.actions:
            return Press("go_on")
        if teaching.phase != "deciding":
            return None
        if self._lets_it_try(teaching):
            return Press("execute")
        if teaching.method is not self._how.method:
            return Press("method", self._how.method.value)
        return self._shows(teaching)

    def _lets_it_try(self, teaching: TeachingState) -> bool:
        """What the robot has just learnt, and what it knows already where they look first."""
        if not teaching.attempts:
            return self._who.looks_first
        last = teaching.attempts[-1]
        return teaching.updates > 0 and last.mode is not Mode.AUTONOMOUS and last.verdict.success

    def _shows(self, teaching: TeachingState) -> Press:
        match self._how:
            case Teaching.PREDICTION:
                return Press("refine")
            case Teaching.REFINEMENT:
                again = teaching.attempts and teaching.basis is not Origin.REFINEMENT
                return Press("basis", Origin.REFINEMENT.value) if again else Press("refine")
            case Teaching.WAYPOINTS:
                return self._through(teaching)
            case Teaching.DEMONSTRATION:
                good = "teach" in teaching.actions and teaching.attempts and teaching.attempts[-1].verdict.success
                return Press("teach" if good else "lead")

    def _through(self, teaching: TeachingState) -> Press:
        """Waypoints that failed are stored anew."""
        if not teaching.waypoints:
            return Press("lead")
        if len(teaching.attempts) > self._tried:
            self._tried = len(teaching.attempts)
            self._press.append(Press("clear"))
            return Press("lead")
        return Press("execute" if "execute" in teaching.actions else "lead")

    def _lead(self, robot: RobotState, now: float) -> None:
        motion = self._motion
        if motion is None or motion.episode != robot.episode:
            motion = self._motion = self._begun(robot)
        if motion is None:
            return
        measured = Pose(np.array(robot.measured.position), np.array(robot.measured.orientation))
        if motion.intention is not None:
            self._hand.correct(motion.helm, now, robot.progress, measured, motion.intention)
        elif (itinerary := motion.itinerary) is not None and not itinerary.over:
            arrived = self._hand.lead(motion.helm, now, measured, itinerary)
            if arrived:
                self._arrived(itinerary, now)

    def _arrived(self, itinerary: Itinerary, now: float) -> None:
        if self._how is Teaching.WAYPOINTS:
            self._do("store", now)
        if itinerary.over:
            self._hand.rest()
            self._done_at = now + CONSIDERS_S

    def _do(self, action: str, now: float) -> None:
        """By the device's button, where it has one, else by the page's."""
        if not self._hand.press(action, now):
            self._press.append(Press(action))

    def _begun(self, robot: RobotState) -> _Motion | None:
        """What they mean to do in a motion; None while not all of it was seen."""
        execution, scene_state, seen = self._execution.latest(), self._scene.latest(), self._object.latest()
        if execution is None or scene_state is None or execution.message.episode != robot.episode:
            return None
        arranged = scene_state.message
        scene = scenes.scene(arranged.name)
        if seen is None and scene.has_object:
            return None
        place = np.array(arranged.condition or (seen.message.pose.position if seen is not None else ()))
        start = Pose(np.array(arranged.start.position), np.array(arranged.start.orientation))
        outlook = Outlook(scene, arranged.variant, place, start)
        sight = Sight(np.array(scene.eye.position), self._who.misjudgement, self._of_sight)
        helm = Helm(Attention(sight, self._who.reaction), self._who.askew)
        if robot.mode is Mode.TEACH:
            predicted = self._predictions.newest()
            known = None if predicted is None else motion_from_wire(predicted.motion)[0]
            way = outlook.way(known, min(self._who.scatter, CAREFUL), self._rng)
            stops = self._how is Teaching.WAYPOINTS
            return _Motion(robot.episode, helm, itinerary=Itinerary(way, stops=stops))
        predicted_motion = self._predictions.motion(execution.message.prediction)
        if predicted_motion is None:
            return None
        positions, orientations, *_ = motion_from_wire(predicted_motion)
        timid = self._how is Teaching.REFINEMENT and self.teaching is not None and not self.teaching.attempts
        share = TIMID if timid else 1.0
        intention = outlook.correction(positions, orientations, self._who.scatter, self._rng, share)
        return _Motion(robot.episode, helm, intention=intention)
