"""A simulated haptic stylus in the hand of a scripted operator, who sees what a person would see."""

from __future__ import annotations

import logging

import numpy as np
from numpy.typing import NDArray

from lfd.exceptions import LfdError
from lfd.motion.trajectory import Trajectory
from protocol.messages import ExecutionState, Figure, Method, Mode, Phase, RobotState, SceneState
from protocol.topics import EXECUTION, OBJECT_POSE, SCENE_STATE, TEACHING_STATE
from services.bus.arrays import motion_from_wire
from services.bus.bus import Bus
from services.bus.predictions import Predictions
from services.master.devices.device import Episode, Moment, Sample
from services.master.devices.simulated_stylus import SimulatedStylus
from services.master.feedback import Feedback
from services.master.haptics import HapticLoop, HapticThread
from services.process.clock import Clock, SystemClock
from services.process.config import RobotSection
from services.process.exceptions import ServiceError
from services.process.master_devices import Scripted
from services.process.robots import scene_of
from sim.exceptions import SimError
from sim.person.hand import Hand, Seen
from sim.person.itinerary import Itinerary
from sim.person.plans import Outlook
from sim.person.scatter import CAREFUL
from sim.person.stylus import Stylus
from sim.pose import Pose
from sim.tasks import AnyScene

log = logging.getLogger(__name__)

_LEFT = 0.002  # [m] a correction that is further from the prediction is not dropped
_TURNED = 0.01  # [rad] nor one that is turned further

_PRESSED_NS = 150_000_000
"""For as long a button of the stylus is held."""

_CONSIDERS_NS = 500_000_000
"""Between the end of what was led and the button that says so."""


class ScriptedMaster:
    """Takes the stylus when an episode is to be refined or led, and lets go at its end.

    Where nothing else leads the robot the hand does: from place to place, storing a waypoint at each by the stylus'
    button, or along the way in one go, as the page asks; at the end the other button says that it is done.

    The force loop has its own thread where time goes by itself; on a clock that is moved by hand it
    advances with every step.

    Args:
        bus: where the hand's eyes are.
        clock: of the process.
        settings: of feedback and hand.
        seed: of all that is a person's: tremor, scatter, choice of a way, misjudged depth.
        robot: in whose scene the hand knows its way.
    """

    name = "stylus"

    def __init__(self, bus: Bus, clock: Clock, settings: Scripted, seed: int, robot: RobotSection) -> None:
        self._execution = bus.subscribe(EXECUTION)
        self._predictions = Predictions(bus)
        self._scene = bus.subscribe(SCENE_STATE)
        self._object = bus.subscribe(OBJECT_POSE)
        self._settings = settings
        self._hand = Hand(seed, settings.misjudgement)
        self._rng = np.random.default_rng((seed, 3))
        self._robot = robot
        self._scenes: dict[str, AnyScene] = {}
        self._feedback = feedback = Feedback(settings.stiffness, settings.damping, settings.force_limit)
        self._loop = HapticLoop(SimulatedStylus(Stylus(), self._hand), feedback, clock.now_ns())
        self._thread = HapticThread(self._loop, clock) if isinstance(clock, SystemClock) else None
        self._gripped: Episode | None = None
        self._teaching = bus.subscribe(TEACHING_STATE)
        self._itinerary: Itinerary | None = None
        self._buttons: list[tuple[str, int]] = []

    def step(self, moment: Moment) -> Sample | None:
        """Look, decide, and read the stylus; None while it is brought to where a correction was left."""
        robot, led = moment.refining, moment.teaching
        if moment.robot is not None and led is None:  # who leads feels nothing: there is nothing to depart from
            self._loop.hear(moment.now_ns)
        self._feedback.contact.hear(robot, robot.master_gain if robot is not None else 1.0)
        if robot is not None:
            self._attend(robot)
            self._hand.observe(moment.now_ns / 1e9, self._seen(robot))
        elif led is not None:
            self._attend(led)
            self._lead(led, moment.now_ns)
        elif moment.robot is not None:  # a picture that stands still for a moment is no reason to let go
            self._let_go()
        rendered = self._loop.newest if self._thread else self._loop.advance_to(moment.now_ns)
        stylus = rendered.stylus
        if robot is not None and not self._hand.clutched and _corrected(robot):
            return None
        return Sample(
            displacement=stylus.position,
            velocity=stylus.velocity,
            rotation=stylus.rotation,
            force=rendered.feedback,
            engaged=self._hand.clutched,
            actions=self._held(moment.now_ns),
            opening=self._opening,
            contact_energy=self._feedback.contact.energy_in,
        )

    def figures(self) -> tuple[Figure, ...]:
        """How regular the force loop is."""
        return self._thread.figures() if self._thread else ()

    def close(self) -> None:
        """Stop the force loop."""
        if self._thread:
            self._thread.close()

    def _let_go(self) -> None:
        self._hand.release()
        self._gripped = self._itinerary = None
        self._buttons.clear()

    def _attend(self, robot: RobotState) -> None:
        """Take the stylus at an episode's beginning, or where this process came up in its middle."""
        episode = (robot.publisher, robot.episode)
        if self._gripped == episode:
            return
        self._hand.release()
        received = self._execution.latest()
        if received is None or (received.message.publisher, received.message.episode) != episode:
            return
        self._gripped = episode
        try:
            taken = self._take(robot, received.message)
        except (SimError, ServiceError, LfdError) as error:
            log.warning("episode %d is not taught: %s", robot.episode, error)
            return
        if not taken:
            self._gripped = None

    def _take(self, robot: RobotState, execution: ExecutionState) -> bool:
        """Take the stylus with what is to be done in mind; False while not all has been seen."""
        received, motion, led = self._scene.latest(), self._known(execution), robot.mode is Mode.TEACH
        place = None if received is None else self._place(received.message, motion)
        if received is None or place is None:
            return False
        arrangement, settings, stylus = received.message, self._settings, self._loop.newest.stylus
        scene = self._scene_named(arrangement.name)
        start = Pose(np.array(arrangement.start.position), np.array(arrangement.start.orientation))
        outlook = Outlook(scene, arrangement.variant, place, start)
        if led:
            known = None if motion is None else motion.positions
            way = outlook.way(known, min(settings.scatter, CAREFUL), self._rng)
            self._itinerary = Itinerary(way, stops=self._stores)
            self._hand.take_up(self._itinerary, stylus, scene.eye)
        elif motion is not None:
            given = (motion.positions, motion.orientations, settings.scatter, self._rng)
            meant = outlook.correction(*given, settings.exaggeration, opening=motion.opening)
            self._hand.grip(meant, stylus, scene.eye)
        return led or motion is not None

    @property
    def _opening(self) -> float | None:
        """That the hand asks of the gripper, as a share of wide open."""
        received, asked = self._scene.latest(), self._hand.opening
        wide = 0.0 if received is None else received.message.wide_open
        return None if asked is None or wide <= 0.0 else min(1.0, asked / wide)

    def _scene_named(self, name: str) -> AnyScene:
        """As the robot tells it; looked up once."""
        if name not in self._scenes:
            self._scenes[name] = scene_of(self._robot, name)
        return self._scenes[name]

    def _known(self, execution: ExecutionState) -> Trajectory | None:
        """What is corrected; where the hand leads alone, what the robot would do by itself as far as that is known."""
        alone = execution.mode is Mode.TEACH
        predicted = self._predictions.newest() if alone else self._predictions.find(execution.prediction)
        return None if predicted is None else Trajectory(*motion_from_wire(predicted.motion))

    def _place(self, arrangement: SceneState, motion: Trajectory | None) -> NDArray[np.float64] | None:
        """Where the target was seen last; where it never was, the robot's guess is as good as any."""
        seen = self._object.latest()
        if arrangement.condition or seen is not None:
            return np.array(arrangement.condition or (seen and seen.message.pose.position))
        return None if motion is None else motion.positions[-1]

    @property
    def _stores(self) -> bool:
        """The page says that waypoints are stored."""
        told = self._teaching.latest()
        return told is not None and told.message.method is Method.WAYPOINTS

    def _lead(self, robot: RobotState, now_ns: int) -> None:
        if robot.phase is not Phase.EXECUTE or self._itinerary is None:
            return
        if self._hand.lead(now_ns / 1e9, self._seen(robot)):
            if self._stores:
                self._buttons.append(("store", now_ns))
            if self._itinerary.over:
                self._buttons.append(("finish", now_ns + _CONSIDERS_NS))

    def _held(self, now_ns: int) -> tuple[str, ...]:
        """The buttons that are held now."""
        self._buttons = [(button, since) for button, since in self._buttons if now_ns < since + _PRESSED_NS]
        return tuple(button for button, since in self._buttons if since <= now_ns)

    def _seen(self, robot: RobotState) -> Seen:
        measured = robot.measured
        return Seen(
            progress=robot.progress,
            robot=Pose(np.array(measured.position), np.array(measured.orientation)),
            offset=np.array(robot.offset) / robot.master_gain,
            turn=np.array(robot.turn),
            stylus=self._loop.newest.stylus,
        )


def _corrected(robot: RobotState) -> bool:
    """The robot is not where the prediction alone would have it."""
    return bool(np.linalg.norm(robot.offset) > _LEFT or np.linalg.norm(robot.turn) > _TURNED)
