"""A robot that a scripted operator corrects: all that the operator sees, and what the robot makes of it."""

import numpy as np

from protocol.messages import (
    AuthorityState,
    ExecutionState,
    Mode,
    ObjectPose,
    OperatorInput,
    Phase,
    Pose,
    Prediction,
    RobotState,
    SceneState,
)
from protocol.topics import (
    AUTHORITY_STATE,
    EXECUTION,
    MASTER_STATE,
    OBJECT_POSE,
    OPERATOR_INPUT,
    PREDICTION,
    ROBOT_STATE,
    SCENE_STATE,
)
from services.bus.arrays import motion_to_wire, quaternion, to_wire, vector3
from services.bus.memory import MemoryNetwork
from services.master.service import build
from services.process.clock import ManualClock
from services.process.config import Configuration, MasterSection
from services.process.master_devices import Scripted
from sim.rotations import rotated
from sim.tasks import DISHWASHER

OBJECT = np.array([0.87, 0.07, 0.553])
UPRIGHT = (1.0, 0.0, 0.0, 0.0)
PERIOD = 0.01
DURATION = 10.0
POINTS = 75
STEADY = Scripted(scatter=0.0, misjudgement=0.0)
LEARNT, SAFE = (DISHWASHER.corridor(variant, OBJECT) for variant in DISHWASHER.variants)


def even(way):
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(way.positions, axis=0), axis=1))])
    shares = np.linspace(0.0, lengths[-1], POINTS)
    positions, orientations = (
        np.column_stack([np.interp(shares, lengths, column) for column in part.T]) for part in way[:2]
    )
    return positions, orientations / np.linalg.norm(orientations, axis=1, keepdims=True)


class Site:
    """A robot that follows equation (16), with everything that the operator's screen shows."""

    scene, variant, condition = "dishwasher", "b2", ()
    admissible = np.ones(3)
    person = Scripted()
    duration = DURATION
    start = DISHWASHER.start

    def __init__(self, seed=0):
        self.seed = seed
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.bus = self.network.bus()
        self.states = self.bus.subscribe(MASTER_STATE)
        self.prediction, self.orientations = even(LEARNT)
        self.announced, self.announced_id = self.prediction, 5
        self.progress, self.offset, self.turn = 0.0, np.zeros(3), np.zeros(3)
        self.ticks = 0
        self.phase, self.episode = Phase.EXECUTE, 1
        self.start_master()

    def start_master(self):
        """As after kill -9: a process that knows nothing."""
        configuration = Configuration(seed=self.seed, master=MasterSection(device=self.person))
        self.service = build(self.network.bus(), self.clock, configuration)

    @property
    def robot(self):
        return self._now(self.prediction) + self.offset

    @property
    def orientation(self):
        nominal = self._now(self.orientations)
        return rotated(nominal / np.linalg.norm(nominal), self.turn)

    def _now(self, rows):
        grid = np.linspace(0.0, 1.0, POINTS)
        return np.array([np.interp(self.progress, grid, column) for column in rows.T])

    def publish(self):
        present = OperatorInput(operator="operator", holder="station", epoch=3, present=True)
        self.bus.publish(OPERATOR_INPUT, present)
        pose = Pose(vector3(self.robot), quaternion(self.orientation))
        robot = RobotState(
            measured=pose,
            reference=pose,
            phase=self.phase,
            mode=Mode.REFINE,
            episode=self.episode,
            progress=self.progress,
            offset=vector3(self.offset),
            turn=vector3(self.turn),
        )
        self.bus.publish(ROBOT_STATE, robot)

    def publish_slowly(self):
        self.bus.publish(AUTHORITY_STATE, AuthorityState(holder="station", epoch=3, expires_in=1.0))
        motion = motion_to_wire(self.announced, self.orientations, self.duration)
        execution = ExecutionState(
            episode=self.episode,
            mode=Mode.REFINE,
            prediction=self.announced_id,
            progress=self.progress,
        )
        self.bus.publish(EXECUTION, execution)
        prediction = Prediction(
            id=self.announced_id,
            motion=motion,
            deviations=to_wire(np.zeros((POINTS, 3))),
            model_version=1,
            object_position=vector3(OBJECT),
        )
        self.bus.publish(PREDICTION, prediction)
        region = (vector3(DISHWASHER.region.lower), vector3(DISHWASHER.region.upper))
        scene = SceneState(
            name=self.scene,
            variant=self.variant,
            boxes=(),
            object_size=(0.05, 0.05, 0.1),
            ellipsoid_radii=vector3(DISHWASHER.reached_radii),
            kicked_over_thresholds=vector3(DISHWASHER.kicked_thresholds),
            start=Pose(vector3(self.start.position), UPRIGHT),
            object_region=region,
            condition=self.condition,
        )
        self.bus.publish(SCENE_STATE, scene)
        if not self.condition:
            self.bus.publish(OBJECT_POSE, ObjectPose(pose=Pose(vector3(OBJECT), UPRIGHT), tag=7))

    def tick(self):
        """One period of everything; the robot holds without fresh samples, and drops what is not engaged."""
        self.clock.advance(PERIOD)
        self.publish()
        if self.ticks % 10 == 0:
            self.publish_slowly()
        self.ticks += 1
        self.service.step(self.clock.now_ns())
        state = self.states.fresh(self.clock.now_ns())
        if state is not None and self.phase is Phase.EXECUTE:
            self.progress = min(1.0, self.progress + PERIOD / self.duration)
            gain = -np.expm1(-PERIOD * (POINTS - 1) / self.duration)
            displacement = self.admissible * state.displacement if state.engaged else np.zeros(3)
            rotation = np.array(state.rotation) if state.engaged else np.zeros(3)
            self.offset = self.offset + gain * (displacement - self.offset)
            self.turn = self.turn + gain * (rotation - self.turn)
        return state


class SteadySite(Site):
    """With a person who means every way alike and misjudges no depth."""

    person = STEADY
