"""What a recording holds of the operator, the robot and the teaching, read back from the file."""

import math

import msgspec
import numpy as np
import pytest

from protocol.messages import (
    Attempt,
    AuthorityEvent,
    AuthorityState,
    Controller,
    DepthPicture,
    ExecutionState,
    Light,
    MasterState,
    Mode,
    ModelState,
    ObjectPose,
    OperatorInput,
    Origin,
    Outcome,
    Part,
    Phase,
    PointCloud,
    Pose,
    RobotState,
    SafetyState,
    TeachingState,
    Trouble,
    Verdict,
)
from protocol.topics import (
    AUTHORITY_STATE,
    DEPTH,
    EXECUTION,
    MASTER_STATE,
    MODEL_STATE,
    OBJECT_POSE,
    OPERATOR_INPUT,
    POINT_CLOUD,
    PREDICTION,
    ROBOT_STATE,
    SAFETY_STATE,
    TEACHING_STATE,
    VERDICT,
)
from services.bus.arrays import motion_to_wire, points_to_wire
from services.bus.depth import depth_to_wire
from tests.services.predictions import prediction

pytestmark = pytest.mark.sim

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
HERE = Pose((0.5, 0.0, 0.5), UPRIGHT)
ANNA = AuthorityState(operator="anna", holder="station-anna", epoch=3, expires_in=1.0)
NOBODY = AuthorityState(holder="", epoch=4, expires_in=0.0)
ROBOT = RobotState(
    joint_names=("arm_1_joint",),
    q=(0.0,),
    qd=(0.0,),
    measured=HERE,
    reference=HERE,
    phase=Phase.EXECUTE,
    mode=Mode.REFINE,
    episode=2,
)
TEACHING = TeachingState(
    phase="refining",
    text="Correct the motion now.",
    light=Light.GREEN,
    refinements=2,
    refinements_allowed=10,
    updates=1,
    updates_allowed=8,
)


def held(*keys, holder="station-anna", **state):
    values = {"operator": "anna", "present": True, "focused": True, **state}
    return OPERATOR_INPUT, OperatorInput(holder=holder, keys=keys, **values)


def changed(message, **values):
    return msgspec.structs.replace(message, **values)


def test_the_keys_that_are_held_are_told_by_their_places(record):
    read = record([held()], [held("KeyE")], [held("KeyE", "ArrowUp")], [held()])
    assert read.states("/states/loop/keys") == ["", "E", "E + ArrowUp", ""]


def test_each_cloud_that_differs_is_recorded_where_its_points_are(record):
    colours = np.zeros((2, 3), dtype=np.uint8)
    here = np.array([[0.5, -0.25, 0.001], [1.0, 0.0, 0.0]])
    near, far = (PointCloud(camera="head", data=points_to_wire(at, colours)) for at in (here, 2.0 * here))
    read = record([(POINT_CLOUD, near)], [(POINT_CLOUD, near)], [(POINT_CLOUD, far)])
    np.testing.assert_allclose(read.values("/world/cloud", "Points3D:positions"), [here, 2.0 * here], atol=1e-6)


def test_a_depth_picture_is_recorded_as_it_came_and_what_is_none_is_not(record):
    near, far = (depth_to_wire(np.full((12, 16), away)) for away in (1.0, 2.0))
    none = DepthPicture(camera="head", width=16, height=12, data=b"none", intrinsics=(1.0,) * 4, pose=HERE)
    ticks = [[(DEPTH, changed(none, data=data))] for data in (near, near, b"none", far)]
    recorded = [bytes(value[0]) for value in record(*ticks).values("/depth", "EncodedDepthImage:blob")]
    assert recorded == [near, far]


def test_the_waypoints_that_are_stored_bear_their_numbers(record):
    there = Pose((0.6, 0.1, 0.5), UPRIGHT)
    read = record(*([(TEACHING_STATE, changed(TEACHING, waypoints=stored))] for stored in ((HERE,), (HERE, there), ())))
    assert read.values("/world/motion/waypoints", "Points3D:labels") == [["1"], ["1", "2"], []]


def test_who_is_at_the_page_and_whether_keys_count_there(record):
    read = record([held()], [held(focused=False)], [held(present=False)])
    assert read.states("/states/loop/operator") == ["anna", "anna, the keys elsewhere", ""]


def test_the_axes_of_a_controller_are_numbers_and_its_buttons_are_told_as_keys_are(record):
    pad = Controller(kind="gamepad", number=1, axes=(0.5, -1.0), buttons=(0.0, 1.0))
    moved = changed(pad, axes=(0.25, 0.0), buttons=(0.0, 0.0))
    read = record([held("KeyE", controllers=(pad,))], [held("KeyE", controllers=(moved,))], [held("KeyE")])
    assert read.values("/series/input/gamepad1") == [[0.5, -1.0], [0.25, 0.0]]
    assert read.states("/states/loop/keys") == ["E + gamepad1 1", "E"]


def test_a_controller_of_a_kind_that_is_not_known_is_another_one(record):
    read = record([held(controllers=(Controller(kind="../[wheel]", axes=(0.5,)),))])
    assert read.values("/series/input/other0") == [[0.5]]


def test_a_device_that_does_not_count_is_told_with_its_trouble(record):
    read = record([(MASTER_STATE, MasterState(trouble=Trouble.NOT_AT_REST, trouble_with="pad", device="keyboard"))])
    assert read.states("/states/loop/master") == ["not at rest: pad"]


def test_the_masters_state_is_in_millimetres_degrees_and_newtons(record):
    master = MasterState(
        displacement=(0.05, 0.0, -0.01),
        rotation=(0.0, math.pi / 6, 0.0),
        force=(0.0, 1.5, 0.0),
        engaged=True,
        device="stylus",
    )
    read = record([(MASTER_STATE, master)], [(MASTER_STATE, changed(master, engaged=False))])
    np.testing.assert_allclose(read.values("/series/master/displacement"), [[50.0, 0.0, -10.0]] * 2)
    np.testing.assert_allclose(read.values("/series/master/rotation"), [[0.0, 30.0, 0.0]] * 2)
    np.testing.assert_allclose(read.values("/series/master/force"), [[0.0, 1.5, 0.0]] * 2)
    assert read.states("/states/loop/master") == ["stylus", ""]


def test_of_several_operators_the_one_who_may_command_is_recorded(record):
    read = record(
        [(AUTHORITY_STATE, ANNA), held("KeyE"), held("KeyQ", holder="station-bert")],
        [held("KeyQ", holder="station-bert")],
    )
    assert read.states("/states/loop/keys") == ["E"]


def test_the_authority_is_told_with_its_epoch_and_how_it_came_to_be(record):
    taken = changed(
        ANNA, operator="bert", holder="station-bert", event=AuthorityEvent.TAKEN_OVER, by="bert", reason="she left"
    )
    read = record(
        *[[(AUTHORITY_STATE, ANNA)]] * 20, *[[(AUTHORITY_STATE, taken)]] * 20, *[[(AUTHORITY_STATE, NOBODY)]] * 20
    )
    anna, bert = "anna at station-anna, epoch 3", "bert at station-bert, epoch 3"
    assert read.states("/states/loop/authority") == [anna, bert, ""]
    assert read.journal() == [
        f"authority: {anna}",
        f"authority: {bert}, taken over by bert: she left",
        "authority: nobody",
    ]


def test_a_stop_is_told_with_who_and_why_and_whether_the_robot_stands(record):
    stopped = SafetyState(emergency_stop=True, by="anna", reason="a cup", self_distance=0.04)
    read = record(
        [(SAFETY_STATE, SafetyState(emergency_stop=False, self_distance=0.05))],
        [(SAFETY_STATE, stopped)],
        [(SAFETY_STATE, changed(stopped, standing=True))],
        [(SAFETY_STATE, SafetyState(emergency_stop=False, released_by="bert", self_distance=0.04))],
    )
    assert read.states("/states/loop/stop") == ["", "anna: a cup, still moving", "anna: a cup, standing", ""]
    assert read.journal() == ["emergency stop by anna: a cup", "emergency stop released by bert"]
    np.testing.assert_allclose(read.values("/series/safety/self_distance"), [[50.0], [40.0], [40.0], [40.0]])


def test_what_is_clamped_and_why_the_robot_holds_is_told(record):
    read = record(
        [(ROBOT_STATE, ROBOT)],
        [(ROBOT_STATE, changed(ROBOT, clamped=("speed", "reach")))],
        [(ROBOT_STATE, changed(ROBOT, phase=Phase.HOLD, hold_reason="nobody is there"))],
        [(ROBOT_STATE, changed(ROBOT, phase=Phase.HOLD, hold_reason="nobody is there", waiting=True))],
    )
    assert read.states("/states/loop/robot/clamped") == ["", "reach, speed", ""]
    assert read.states("/states/loop/robot/phase") == ["execute", "hold"]
    assert read.states("/states/loop/robot/hold") == ["", "nobody is there", "nobody is there, waits to be asked"]
    assert read.states("/states/loop/robot/episode") == ["2, refine"]


def test_an_episode_is_told_with_its_pace_and_the_part_that_is_corrected(record):
    execution = ExecutionState(episode=2, mode=Mode.REFINE, prediction=1, progress=0.5)
    read = record(
        [(ROBOT_STATE, ROBOT), (EXECUTION, execution)],
        [(ROBOT_STATE, ROBOT), (EXECUTION, changed(execution, pace=-0.5, part=Part(0.25, 0.75)))],
        [(ROBOT_STATE, changed(ROBOT, phase=Phase.IDLE))],
    )
    assert read.states("/states/loop/robot/episode") == ["2, refine", "2, refine, pace -0.5, from 25 to 75 %", ""]


def test_what_was_commanded_lies_beside_what_was_measured_and_their_difference(record):
    turned = (math.cos(0.05), 0.0, math.sin(0.05), 0.0)
    read = record([(ROBOT_STATE, changed(ROBOT, measured=Pose((0.503, 0.0, 0.498), turned)))])
    np.testing.assert_allclose(read.values("/series/following/commanded"), [[0.5, 0.0, 0.5]])
    np.testing.assert_allclose(read.values("/series/following/measured"), [[0.503, 0.0, 0.498]])
    np.testing.assert_allclose(read.values("/series/error/position"), [[3.0, 0.0, -2.0]], atol=1e-9)
    np.testing.assert_allclose(read.values("/series/error/orientation"), [[math.degrees(0.1)]])


def test_the_correction_is_as_the_robot_applies_it(record):
    read = record([(ROBOT_STATE, changed(ROBOT, offset=(0.05, 0.0, -0.01), turn=(0.0, math.pi / 6, 0.0)))])
    np.testing.assert_allclose(read.values("/series/correction/offset"), [[50.0, 0.0, -10.0]])
    np.testing.assert_allclose(read.values("/series/correction/turn"), [[0.0, 30.0, 0.0]])


def test_the_teaching_is_told_with_its_sentence_and_what_was_tried(record):
    tried = Attempt(
        scene="dishwasher",
        object_position=HERE.position,
        model_version=2,
        operator_input=True,
        verdict=Outcome(reached=True, kicked_over=False, collision=True),
        duration_s=12.34,
        variant="b2",
        mode=Mode.REFINE,
        number=1,
    )
    read = record([(TEACHING_STATE, TEACHING)], [(TEACHING_STATE, changed(TEACHING, attempts=(tried,)))])
    assert read.states("/states/teaching/phase") == ["refining"]
    assert read.states("/states/teaching/attempt") == ["attempts 2 of 10, updates 1 of 8"]
    assert read.journal() == ["refining: Correct the motion now."]
    (before,), (after,) = read.values("/attempts", "TextDocument:text")
    assert before == "No episode yet."
    assert after.splitlines()[-1] == "| 1 | refine, by hand | 2 | reached, collision | 12.3 |"


def test_the_models_version_is_told_and_where_the_motion_that_is_seen_comes_from(record):
    motion = motion_to_wire([[0.0] * 3, [1.0] * 3], [UPRIGHT] * 2, 1.0)
    predicted = changed(prediction(motion), model_version=3, known=0.2)
    state = ModelState(kind="adaptive", version=4, demonstrations=5, updates=2, scene="dishwasher")
    shown = changed(predicted, id=predicted.id + 1, origin=Origin.WAYPOINTS)
    read = record([(MODEL_STATE, state), (PREDICTION, predicted)], [(PREDICTION, shown)])
    assert read.states("/states/teaching/model") == ["adaptive 4: 5 shown, 2 learnt since"]
    told = ["model version 3: 20 % known", "waypoints, model version 3"]
    assert read.states("/states/teaching/prediction") == told
    assert read.journal() == [f"prediction of {text}" for text in told]


def test_a_minute_is_few_chunks_of_many_rows_and_few_words(record):
    """A robot that holds and goes on all the time, tapped at by keys: as bad as it was seen on a loaded machine."""

    def tick(number):
        holds = number // 20 % 2
        phase, reason = (Phase.HOLD, "keys or device were not heard") if holds else (Phase.EXECUTE, "")
        return [
            (AUTHORITY_STATE, ANNA),
            held(*(["KeyE"] if number // 10 % 2 else []), controllers=(Controller(kind="gamepad", axes=(0.1, 0.2)),)),
            (MASTER_STATE, MasterState(displacement=(1e-4 * number, 0.0, 0.0), holder="station-anna", engaged=True)),
            (ROBOT_STATE, changed(ROBOT, q=(1e-4 * number,), phase=phase, hold_reason=reason, applied_latency=0.01)),
            (OBJECT_POSE, ObjectPose(pose=HERE, tag=7, error=0.001)),
            (VERDICT, Verdict(reached=False, kicked_over=False, collision=False)),
            (TEACHING_STATE, TEACHING),
        ]

    read = record(*(tick(number) for number in range(1800)))
    fast = [entity for entity in read.entities if entity.startswith("/series/") and read.moving(entity)]
    assert len(fast) >= 12
    for entity in [*fast, "/robot/moving", "/world/grasp"]:
        rows = read.moving(entity)
        assert sum(rows) >= 1800
        assert np.mean(rows) >= 20.0, entity
    assert sum(len(read.moving(entity)) for entity in read.entities if entity.startswith("/states/")) <= 250
    assert len(read.journal()) <= 10
