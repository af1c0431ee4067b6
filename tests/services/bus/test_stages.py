"""The way from hand to eye comes together from what each message says, and what nobody knows stays unknown."""

import pytest

from protocol.messages import Figure, MasterState, OperatorInput, Phase, Pose, RobotState
from services.bus.stages import LASTING_NS, LONGEST_S, NAMES, Lasting, Stages, from_figures, merged, stages

POSE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))


def robot(**told):
    return RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, **told)


WHOLE = stages(
    OperatorInput(drawn=0.031),
    MasterState(capture=0.012),
    robot(applied_latency=0.024, applied_way=0.018, following_lag=0.02),
)


def test_each_message_says_its_stages_and_together_they_are_the_way():
    assert Stages(0.012, 0.018, pytest.approx(0.006), 0.02, 0.031) == WHOLE
    assert WHOLE.complete
    assert WHOLE.total == pytest.approx(0.087)


def test_what_no_message_says_is_unknown_and_not_nothing():
    assert stages() == Stages() == stages(OperatorInput(), MasterState(), robot())
    assert Stages().known == ()
    partly = stages(robot=robot(applied_latency=0.024, applied_way=0.018))
    assert partly.known == (0.018, pytest.approx(0.006))
    assert not partly.complete
    assert partly.total == pytest.approx(0.024)


def test_a_robot_that_knows_its_latency_but_not_the_way_tells_neither_part():
    assert stages(robot=robot(applied_latency=0.024)) == Stages()


@pytest.mark.parametrize("value", [-1.0, LONGEST_S + 1.0, 1e9])
def test_what_can_be_no_delay_is_unknown_and_makes_no_figure(value):
    told = stages(OperatorInput(drawn=value), MasterState(capture=value), robot(following_lag=value))
    assert told.figures() == ()


def test_of_no_time_a_stage_is_known():
    assert stages(robot=robot(applied_latency=0.0, applied_way=0.0)) == Stages(way=0.0, apply=0.0)


def test_what_is_measured_now_and_then_lasts_a_while():
    lasting = Lasting()
    lasting.see(Stages(capture=0.012, way=0.018), 0)
    lasting.see(Stages(way=0.020), LASTING_NS)
    assert lasting.at(LASTING_NS) == Stages(capture=0.012, way=0.020)
    assert lasting.at(LASTING_NS + 1) == Stages(way=0.020)
    lasting.forget()
    assert lasting.at(LASTING_NS) == Stages()


def test_what_several_processes_know_is_one_way():
    assert merged([Stages(capture=0.012), Stages(way=0.018), Stages()]) == Stages(capture=0.012, way=0.018)


def test_what_heartbeats_tell_is_the_same_way():
    figures = [Figure("simulation_lag", 0.5, "s"), Figure("stage_later", 1.0, "ms"), *WHOLE.figures()]
    read = from_figures(figures)
    assert read.known == pytest.approx(WHOLE.known)
    assert from_figures(Stages(motion=0.02).figures()) == Stages(motion=0.02)
    assert [figure.name for figure in WHOLE.figures()] == [f"stage_{name}" for name in NAMES]
