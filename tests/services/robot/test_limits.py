"""The limits of the robot as numbers: whoever changes one decides it here as well."""

import pytest

from services.process import config
from services.robot import admission, clutch, episode, execution, hold, latch, memory, safety, teleoperation


@pytest.mark.parametrize(
    ("room", "limits"),
    [
        (config, {"LONGEST_SILENCE_S": 0.25, "LONGEST_LEASE_S": 3.0}),
        (
            safety,
            {
                "REFERENCE_SPEED": 1.2,
                "REFERENCE_TURN_SPEED": 1.5,
                "DISPLACEMENT_REACH": 0.3,
                "ROTATION_REACH": 1.0,
                "STANDING_SPEED": 0.01,
                "FORCE_STOP": 300.0,
                "ROUNDING": 1e-9,
            },
        ),
        (
            admission,
            {
                "MOST_POINTS": 1000,
                "SHORTEST_S": 0.5,
                "LONGEST_S": 120.0,
                "FASTEST": 1.0,
                "FASTEST_TURN": 3.0,
                "START_DISTANCE": 0.5,
                "START_REACH": 0.3,
            },
        ),
        (
            execution,
            {
                "RAMP_MIN_S": 0.5,
                "RAMP_SPEED": 0.15,
                "RAMP_TURN_SPEED": 0.5,
                "STILL_THERE": 0.01,
                "STILL_TURNED": 0.1,
                "INPUT_THRESHOLD": 0.0005,
                "TURN_THRESHOLD": 0.005,
            },
        ),
        (clutch, {"NEUTRAL": 0.01, "NEUTRAL_TURN": 0.1, "FADE": 0.05, "FADE_TURN": 0.2}),
        (hold, {"LONG_HOLD_S": 0.5}),
        (memory, {"RESERVED": 1024, "RETRY": 100}),
        (latch, {"LONGEST_REASON": 500}),
        (episode, {"SETTLE_S": 0.5}),
        (teleoperation, {"LONGEST_S": 600.0, "LEASH": 0.03, "LEASH_TURN": 0.15, "MOST_POINTS": 4000}),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_the_limits_are_these(room, limits):
    assert {name: getattr(room, name) for name in limits} == limits
