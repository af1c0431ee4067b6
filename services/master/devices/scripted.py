"""A simulated haptic stylus in the hand of a scripted operator, who sees what a person would see."""

from __future__ import annotations

import logging

import numpy as np
from numpy.typing import NDArray

from lfd.exceptions import LfdError
from lfd.motion.trajectory import Trajectory
from protocol.messages import ExecutionState, Figure, RobotState
from protocol.topics import EXECUTION, OBJECT_POSE, SCENE_STATE
from services.bus.arrays import motion_from_wire
from services.bus.bus import Bus
from services.bus.predictions import Predictions
from services.master.devices.device import Moment, Sample
from services.master.devices.simulated_stylus import SimulatedStylus
from services.master.feedback import Feedback
from services.master.haptics import HapticLoop, HapticThread
from services.process.clock import Clock, SystemClock
from services.process.exceptions import ServiceError
from services.process.master_devices import Scripted
from sim import tasks as scenes
from sim.exceptions import SimError
from sim.person.hand import Hand, Seen
from sim.person.imagination import chosen, imagined
from sim.person.intention import Intention, plan, plan_at_equal_progress
from sim.person.stylus import Stylus
from sim.pose import Pose
from sim.tasks.scene import Eye

log = logging.getLogger(__name__)

_LEFT = 0.002  # [m] a correction that is further from the prediction is not dropped
_TURNED = 0.01  # [rad] nor one that is turned further

Episode = tuple[int, int]
"""The robot process' identity and its number for the episode."""


class ScriptedMaster:
    """Takes the stylus when an episode is to be refined, and lets go at its end.

    The force loop has its own thread where time goes by itself; on a clock that is moved by hand it
    advances with every step.

    Args:
        bus: where the hand's eyes are.
        clock: of the process.
        settings: of feedback and hand.
        seed: of all that is a person's: tremor, scatter, choice of a way, misjudged depth.
    """

    name = "stylus"

    def __init__(self, bus: Bus, clock: Clock, settings: Scripted, seed: int) -> None:
        self._execution = bus.subscribe(EXECUTION)
        self._predictions = Predictions(bus)
        self._scene = bus.subscribe(SCENE_STATE)
        self._object = bus.subscribe(OBJECT_POSE)
        self._settings = settings
        self._hand = Hand(seed, settings.misjudgement)
        self._rng = np.random.default_rng((seed, 3))
        feedback = Feedback(settings.stiffness, settings.damping, settings.force_limit)
        self._loop = HapticLoop(SimulatedStylus(Stylus(), self._hand), feedback, clock.now_ns())
        self._thread = HapticThread(self._loop, clock) if isinstance(clock, SystemClock) else None
        self._gripped: Episode | None = None

    def step(self, moment: Moment) -> Sample | None:
        """Look, decide, and read the stylus; None while it is brought to where a correction was left."""
        robot = moment.refining
        if moment.robot is not None:
            self._loop.hear(moment.now_ns)
        if robot is not None:
            self._attend(robot)
            self._look(robot, moment.now_ns)
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
        self._gripped = None

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
            planned = self._plan(received.message)
        except (SimError, ServiceError, LfdError) as error:
            log.warning("episode %d is not corrected: %s", robot.episode, error)
            return
        if planned is None:
            self._gripped = None
            return
        correction, eye = planned
        self._hand.grip(correction, self._loop.newest.stylus, eye)

    def _plan(self, execution: ExecutionState) -> tuple[Intention, Eye] | None:
        """The correction of an episode, and from where it is watched; None while not all has been seen."""
        scene_state, predicted = self._scene.latest(), self._predictions.motion(execution.prediction)
        if scene_state is None or predicted is None:
            return None
        arrangement = scene_state.message
        prediction = Trajectory(*motion_from_wire(predicted))
        scene = scenes.scene(arrangement.name)
        place = np.array(arrangement.condition or self._object_position(prediction.positions))
        start = Pose(np.array(arrangement.start.position), np.array(arrangement.start.orientation))
        safe = chosen(scene.corridors(arrangement.variant, place, start), prediction.positions, self._rng)
        meant = imagined(safe, prediction.positions, self._settings.scatter, self._rng, scene.freedom)
        poses, exaggeration = (prediction.positions, prediction.orientations), self._settings.exaggeration
        if not scene.freedom.tempo:
            return plan_at_equal_progress(*poses, meant, exaggeration), scene.eye
        known = [way for variant in scene.variants for way in scene.corridors(variant, place, start)]
        return plan(*poses, meant, known, exaggeration), scene.eye

    def _object_position(self, prediction: NDArray[np.float64]) -> NDArray[np.float64]:
        """Where the object was seen last; where it never was, the robot's guess is as good as any."""
        seen = self._object.latest()
        return np.array(seen.message.pose.position) if seen else prediction[-1]

    def _look(self, robot: RobotState, now_ns: int) -> None:
        measured = robot.measured
        seen = Seen(
            progress=robot.progress,
            robot=Pose(np.array(measured.position), np.array(measured.orientation)),
            offset=np.array(robot.offset) / robot.master_gain,
            turn=np.array(robot.turn),
            stylus=self._loop.newest.stylus,
        )
        self._hand.observe(now_ns / 1e9, seen)


def _corrected(robot: RobotState) -> bool:
    """The robot is not where the prediction alone would have it."""
    return bool(np.linalg.norm(robot.offset) > _LEFT or np.linalg.norm(robot.turn) > _TURNED)
