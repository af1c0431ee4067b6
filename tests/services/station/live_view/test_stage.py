"""What the live view shows of what the station hears."""

import msgspec
import numpy as np
import pytest

from lfd.haptics import DAMPING, STIFFNESS
from protocol import topics
from protocol.messages import (
    Box,
    EpisodeResult,
    ExecutionState,
    MasterState,
    Mode,
    ObjectPose,
    Origin,
    Part,
    Phase,
    Pose,
    RobotState,
    SceneState,
    Verdict,
)
from services.bus.arrays import motion_to_wire, to_wire
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.station.ears import Ears
from services.station.live_view.drawing import Going, Kick
from services.station.live_view.stage import Stage
from tests.services.predictions import announce, prediction

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
POSE = Pose((0.5, 0.0, 0.5), UPRIGHT)
BOX = Box("table", (0.8, 0.0, 0.3), (0.1, 0.2, 0.3), UPRIGHT, (1.0, 0.5, 0.2, 1.0))
SCENE = SceneState(
    name="s",
    variant="b1",
    boxes=(BOX,),
    object_size=(0.05, 0.05, 0.1),
    ellipsoid_radii=(0.05, 0.06, 0.05),
    kicked_over_thresholds=(0.1, 0.1, 0.1),
    start=POSE,
    object_region=((0.0,) * 3, (1.0,) * 3),
)


class Network:
    """A station's ears, its stage, and whoever speaks to it."""

    def __init__(self):
        self.clock = ManualClock()
        network = MemoryNetwork(self.clock)
        self.other = network.bus()
        self.stage = Stage(Ears(network.bus()))

    def seen(self):
        return self.stage.drawing(self.clock.now_ns())

    def robot(self, x, phase=Phase.EXECUTE):
        reference = Pose((x, 0.0, 0.5), UPRIGHT)
        state = RobotState(measured=POSE, reference=reference, phase=phase, episode=1)
        self.other.publish(topics.ROBOT_STATE, state)


def line(x, count=3):
    return motion_to_wire(np.linspace((x, 0.0, 0.0), (x + 1.0, 0.0, 0.0), count), [UPRIGHT] * count, 1.0)


def test_before_anything_is_heard_there_is_nothing_to_draw():
    network = Network()
    assert (network.seen().boxes, network.seen().prediction, network.seen().way) == ((), None, ())
    assert network.stage.force(network.clock.now_ns()) == (0.0, 0.0, 0.0)


def test_the_scene_is_drawn_as_the_robot_announces_it():
    network = Network()
    network.other.publish(topics.SCENE_STATE, SCENE)
    assert (network.seen().boxes, network.seen().size) == ((BOX,), SCENE.object_size)
    assert network.seen().criteria.radii == SCENE.ellipsoid_radii


def test_the_criteria_are_the_verdicts():
    network = Network()
    touched = {"collision": True, "collision_position": (0.5, 0.1, 0.2), "collision_force": 4.0}
    network.other.publish(topics.VERDICT, Verdict(reached=True, kicked_over=False, **touched))
    criteria = network.seen().criteria
    assert (criteria.reached, criteria.collision, criteria.force) == (True, (0.5, 0.1, 0.2), 4.0)


def test_the_object_may_be_moved_so_far_round_the_place_where_it_stood():
    """However far it has been moved since."""
    network = Network()
    assert network.seen().kick == Kick()
    network.other.publish(topics.SCENE_STATE, SCENE)
    network.other.publish(topics.OBJECT_POSE, ObjectPose(pose=Pose((0.85, 0.1, 0.6), UPRIGHT), tag=7, error=0.0))
    moved = Verdict(reached=False, kicked_over=True, collision=False, object_displacement=(0.15, 0.0, 0.0))
    network.other.publish(topics.VERDICT, moved)
    assert network.seen().kick == Kick((0.7, 0.1, 0.6), SCENE.kicked_over_thresholds, kicked=True)


def test_where_there_is_no_object_nothing_can_be_kicked_over():
    network = Network()
    network.other.publish(topics.SCENE_STATE, msgspec.structs.replace(SCENE, object_size=(0.0, 0.0, 0.0)))
    network.other.publish(topics.OBJECT_POSE, ObjectPose(pose=POSE, tag=7, error=0.0))
    network.other.publish(topics.VERDICT, Verdict(reached=False, kicked_over=False, collision=False))
    assert network.seen().kick == Kick()


def test_it_is_told_whether_a_motion_was_predicted_or_shown():
    network = Network()
    for origin in Origin:
        shown = msgspec.structs.replace(prediction(line(0.0)), origin=origin)
        network.other.publish(topics.PREDICTION, shown)
        assert network.seen().prediction.origin is origin


def test_the_axes_are_turned_as_the_operator_s_device_says():
    network = Network()
    assert network.seen().yaw == 0.0
    network.other.publish(topics.MASTER_STATE, MasterState(yaw=0.5))
    assert network.seen().yaw == 0.5


def test_the_newest_prediction_is_drawn_in_the_tube_of_two_standard_deviations():
    network = Network()
    told = prediction(line(0.0))
    network.other.publish(topics.PREDICTION, told)
    assert network.seen().prediction.points == ((0.0, 0.0, 0.0), (0.5, 0.0, 0.0), (1.0, 0.0, 0.0))
    assert network.seen().prediction.spread == ((0.0, 0.0, 0.0),) * 3
    assert network.seen().prediction is network.seen().prediction


def test_while_a_motion_is_under_way_it_is_the_one_to_see():
    network = Network()
    first = announce(network.other, line(0.0))
    announce(network.other, line(7.0))
    assert network.seen().prediction.points[0] == (7.0, 0.0, 0.0)
    network.other.publish(topics.EXECUTION, ExecutionState(episode=1, mode=Mode.REFINE, prediction=first, progress=0.1))
    assert network.seen().prediction.points[0] == (0.0, 0.0, 0.0)


def test_a_long_motion_is_told_in_no_more_points_than_can_be_told_apart():
    network = Network()
    announce(network.other, line(0.0, 2_000))
    points = network.seen().prediction.points
    assert len(points) <= 80
    assert (points[0], points[-1]) == ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))


@pytest.mark.parametrize("wrong", [np.nan, 1e7])
def test_what_cannot_be_drawn_is_left_out(wrong):
    network = Network()
    network.other.publish(topics.PREDICTION, prediction(motion_to_wire([[wrong] * 3] * 2, [UPRIGHT] * 2, 1.0)))
    assert network.seen().prediction is None


def test_a_tube_that_does_not_fit_its_motion_is_left_out():
    network = Network()
    told = prediction(line(0.0))
    network.other.publish(topics.PREDICTION, type(told)(**{**fields(told), "deviations": to_wire(np.ones((2, 3)))}))
    assert network.seen().prediction.spread == ()


def fields(message):
    return {name: getattr(message, name) for name in ("id", "motion", "model_version", "object_position")}


def test_the_way_is_where_the_motion_has_led_so_far():
    network = Network()
    for x in (0.0, 0.1, 0.2):
        network.robot(x)
        network.seen()
    network.robot(0.9, Phase.HOLD)
    assert network.seen().way == ((0.0, 0.0, 0.5), (0.1, 0.0, 0.5), (0.2, 0.0, 0.5))


def test_the_force_is_the_masters_as_long_as_it_is_heard():
    network = Network()
    network.other.publish(topics.MASTER_STATE, MasterState(force=(0.0, 1.5, 0.0)))
    assert network.stage.force(network.clock.now_ns()) == (0.0, 1.5, 0.0)
    network.clock.advance(5.0)
    assert network.stage.force(network.clock.now_ns()) == (0.0, 0.0, 0.0)


def test_of_a_device_without_a_force_it_is_what_one_with_a_force_would_render():
    network = Network()
    state = MasterState(displacement=(0.0, 0.02, 0.0), velocity=(0.0, 0.0, 0.1), engaged=True)
    network.other.publish(topics.MASTER_STATE, state)
    assert network.stage.force(network.clock.now_ns()) == pytest.approx((0.0, -STIFFNESS * 0.02, -DAMPING * 0.1))
    network.other.publish(topics.MASTER_STATE, MasterState(displacement=(0.0, 0.02, 0.0)))
    assert network.stage.force(network.clock.now_ns()) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("mode", "look_ahead", "going"),
    [
        (Mode.REFINE, 0.25, Going(80.0, 0.25, 0.5, corrected=True)),
        (Mode.AUTONOMOUS, 0.25, Going(80.0, 0.25, 0.5, corrected=False)),
        (Mode.REFINE, 0.0, Going(0.0, 0.25, 0.5, corrected=True)),
        (Mode.TEACH, 0.25, None),
    ],
)
def test_how_a_correction_fades_is_told_of_a_motion_that_has_a_prediction(mode, look_ahead, going):
    network = Network()
    assert network.seen().going is None
    told = ExecutionState(
        episode=1,
        mode=mode,
        prediction=1,
        progress=0.1,
        duration=20.0,
        look_ahead=look_ahead,
        part=Part(0.25, 0.5),
    )
    network.other.publish(topics.EXECUTION, told)
    assert network.seen().going == going


def result(prediction, **shares):
    motion = line(1.0)
    return EpisodeResult(
        episode=1,
        request=1,
        mode=Mode.AUTONOMOUS,
        completed=True,
        reason="",
        prediction=prediction,
        refined=motion,
        commanded=motion,
        measured=motion,
        verdict=Verdict(reached=False, kicked_over=False, collision=True),
        operator_input=False,
        clamped=0,
        held=0.0,
        duration=1.0,
        **shares,
    )


def test_where_the_last_episode_of_the_motion_that_is_shown_was_spoilt_is_told():
    network = Network()
    shown = announce(network.other, line(1.0))
    network.seen()

    def ended(prediction, **shares):
        network.other.publish(topics.EPISODE_RESULT, result(prediction, **shares))
        return network.stage.spoilt(network.clock.now_ns())

    assert ended(shown, progress=1.0, clear_until=0.6) == (0.6,)
    assert ended(shown, progress=0.6, clear_until=0.6) == ()
    assert ended(shown + 1, progress=1.0, clear_until=0.6) == ()
