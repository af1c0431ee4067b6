"""The way of an episode is followed while it is executed, and never grows without bound."""

import numpy as np

from protocol.messages import Phase, Pose, RobotState
from services.bus.trace import POINTS_KEPT, SPACING, Trace

UPRIGHT = (1.0, 0.0, 0.0, 0.0)


def robot(x, phase=Phase.EXECUTE, episode=1, progress=0.0):
    return RobotState(
        measured=Pose((9.0, 0.0, 0.0), UPRIGHT),
        reference=Pose((x, 0.0, 0.0), UPRIGHT),
        phase=phase,
        episode=episode,
        progress=progress,
        publisher=1,
    )


def test_it_follows_the_reference_while_an_episode_is_executed():
    trace = Trace()
    for phase, x in ((Phase.RAMP, -1.0), (Phase.EXECUTE, 0.0), (Phase.EXECUTE, 0.1), (Phase.HOLD, 0.3)):
        trace.see(robot(x, phase))
    np.testing.assert_array_equal(trace.points, [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0]])


def test_it_says_when_the_way_is_another_one():
    trace = Trace()
    seen = [trace.see(robot(x)) for x in (0.0, 0.1 * SPACING, 2.0 * SPACING)]
    assert [*seen, trace.see(robot(2.0 * SPACING, episode=2)), trace.see(robot(0.0, Phase.HOLD, episode=2))] == [
        True,
        False,
        True,
        True,
        False,
    ]


def test_another_episode_begins_another_way():
    trace = Trace()
    trace.see(robot(0.0))
    trace.see(robot(0.5, episode=2))
    np.testing.assert_array_equal(trace.points, [[0.5, 0.0, 0.0]])
    trace.see(robot(0.7, Phase.RAMP, episode=3))
    assert trace.points.shape == (0, 3)


def test_points_that_nobody_tells_apart_are_one_and_an_endless_episode_has_no_more_than_are_kept():
    trace = Trace()
    trace.see(robot(0.0))
    trace.see(robot(0.9 * SPACING))
    assert len(trace.points) == 1
    for i in range(2 * POINTS_KEPT):
        trace.see(robot(2.0 * SPACING * (i + 1)))
    assert len(trace.points) == POINTS_KEPT


def test_what_was_passed_is_forgotten_where_the_motion_goes_back():
    trace = Trace()
    for x, progress in ((0.0, 0.0), (0.1, 0.1), (0.2, 0.2), (0.3, 0.3)):
        trace.see(robot(x, progress=progress))
    assert trace.see(robot(0.15, progress=0.15))
    np.testing.assert_array_equal(trace.points[:, 0], [0.0, 0.1, 0.15])
    trace.see(robot(0.5, progress=0.4))
    np.testing.assert_array_equal(trace.points[:, 0], [0.0, 0.1, 0.15, 0.5])
