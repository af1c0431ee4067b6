import numpy as np
import pytest

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
from services.process.config import Configuration, MasterSection, Scripted
from sim.rotations import rotated, rotation_to
from sim.tasks import DISHWASHER, PARTICLE

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
        np.column_stack([np.interp(shares, lengths, column) for column in part.T]) for part in way
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


@pytest.mark.sim
def test_a_steady_hand_leads_the_robot_along_the_safe_way():
    site = SteadySite()
    errors = []
    while site.progress < 1.0:
        state = site.tick()
        errors.append(np.min(np.linalg.norm(even(SAFE)[0] - site.robot, axis=1)))
    assert state.device == "stylus"
    assert state.epoch == 3
    assert max(errors) < 0.03
    assert np.linalg.norm(site.robot - SAFE.positions[-1]) < 0.015


@pytest.mark.sim
def test_a_person_leads_the_robot_as_near_to_the_safe_way_as_people_repeat_theirs_and_to_the_object():
    errors, ends = [], []
    for seed in range(3):
        site = Site(seed)
        while site.progress < 1.0:
            site.tick()
            errors.append(np.min(np.linalg.norm(even(SAFE)[0] - site.robot, axis=1)))
        ends.append(np.linalg.norm(site.robot - SAFE.positions[-1]))
    assert 0.010 < np.sqrt(np.mean(np.square(errors))) < 0.052
    assert max(ends) < 0.045


@pytest.mark.sim
def test_the_hand_turns_the_robot_as_the_way_is_turned():
    """A prediction that was learnt rolled, more and more until it is wrong by half a radian at the object."""
    site = SteadySite()
    site.orientations = rotated(site.orientations, np.outer(np.linspace(0.0, 1.0, POINTS), [0.5, 0.0, 0.0]))
    while site.progress < 1.0:
        state = site.tick()
    assert np.linalg.norm(state.rotation) > 0.4
    assert np.linalg.norm(rotation_to(site.orientation, SAFE.orientations[-1])) < 0.03
    assert np.linalg.norm(site.robot - SAFE.positions[-1]) < 0.015


@pytest.mark.sim
def test_the_hand_lets_go_at_the_episodes_end_and_the_stylus_returns():
    site = SteadySite()
    for _ in range(400):
        state = site.tick()
    assert state.engaged
    assert np.linalg.norm(state.displacement) > 0.05
    site.phase = Phase.IDLE
    assert not site.tick().engaged
    for _ in range(200):
        state = site.tick()
    np.testing.assert_allclose(state.displacement, 0.0, atol=1e-3)


@pytest.mark.sim
def test_a_master_that_died_takes_over_where_the_robot_stands():
    site = SteadySite()
    site.orientations = rotated(site.orientations, [0.3, 0.0, 0.0])
    while site.progress < 0.4:
        site.tick()
    held, turned, progress = site.offset, site.turn, site.progress
    assert np.linalg.norm(held) > 0.05
    assert np.linalg.norm(turned) > 0.2
    site.start_master()
    site.clock.advance(1.0)
    while site.tick() is None:
        np.testing.assert_array_equal(site.offset, held)
        np.testing.assert_array_equal(site.turn, turned)
        assert site.progress == progress
        assert site.ticks < 1000
    assert site.states.latest().message.engaged
    moves, turns = [], []
    while site.progress < 1.0:
        before, turned = site.offset, site.turn
        site.tick()
        moves.append(np.linalg.norm(site.offset - before) / PERIOD)
        turns.append(np.linalg.norm(site.turn - turned) / PERIOD)
    assert max(moves) < 0.25
    assert max(turns) < 0.5
    assert np.linalg.norm(site.robot - SAFE.positions[-1]) < 0.015


@pytest.mark.sim
def test_a_cut_link_is_sat_out_with_the_hand_on_the_stylus():
    """Nothing is said while the robot is not heard; then the correction goes on from where it stands."""
    site = Site()
    while site.progress < 0.4:
        site.tick()
    before = site.offset
    for _ in range(150):
        site.clock.advance(PERIOD)
        site.service.step(site.clock.now_ns())
    assert site.states.fresh(site.clock.now_ns()) is None
    state = site.tick()
    assert state.engaged
    assert np.linalg.norm(np.array(state.displacement) - before) < 0.02


class ParticleSite(Site):
    """The particle, on a straight way that it has learnt for another condition."""

    scene = "particle"
    admissible = np.array(PARTICLE.freedom.axes)
    person = STEADY
    duration = 20.0
    start = PARTICLE.start

    def __init__(self, variant, condition):
        super().__init__()
        self.variant, self.condition = variant, condition
        self.prediction, self.orientations = even(PARTICLE.corridor("free", np.zeros(2)))
        self.announced = self.prediction


@pytest.mark.sim
@pytest.mark.parametrize("variant", PARTICLE.variants)
@pytest.mark.parametrize("condition", [(0.1, -0.1), (-0.1, 0.06), (0.03, 0.1), (-0.2, 0.2)])
def test_the_hand_leads_the_particle_through_its_via_points(variant, condition):
    site = ParticleSite(variant, condition)
    way = PARTICLE.corridor(variant, np.array(condition)).positions
    passed = []
    while site.progress < 1.0:
        site.tick()
        passed.append(site.robot)
    x, y, _ = np.transpose(passed)
    np.testing.assert_allclose(np.interp(PARTICLE.via_x, x, y), condition, atol=PARTICLE.tolerance)
    assert np.max(np.abs(y - np.interp(x, way[:, 0], way[:, 1]))) < 0.02


@pytest.mark.parametrize("fault", ["scene", "prediction", "orientation"])
def test_what_cannot_be_planned_is_not_touched(fault, caplog):
    site = Site()
    if fault == "scene":
        site.scene = "moon"
    elif fault == "prediction":
        site.announced = np.full((POINTS, 3), np.nan)
    else:
        site.orientations = 2.0 * site.orientations
    for _ in range(50):
        state = site.tick()
    assert not state.engaged
    assert caplog.text.count("episode 1 is not corrected") == 1
