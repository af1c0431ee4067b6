"""The profiles that work without a file, one a kind of device."""

from __future__ import annotations

from services.process.profile import Buttons, Profile, Way, Ways

STANDARD_GAMEPAD = Profile(
    "gamepad",
    ways=Ways(
        x=Way(axis=1, sign=-1),  # a stick's axes point right and, as pages count, down
        y=Way(axis=0, sign=-1),
        z=Way(axis=3, sign=-1),
        yaw=Way(axis=2, sign=-1),
        roll=Way(plus=5, minus=4),  # bumpers
        pitch=Way(plus=7, minus=6),  # triggers
    ),
    buttons=Buttons(finish=0, store=2, gripper=3),
)
"""Left stick: forward and left; right stick: up and turn; bumpers roll, triggers tilt; the gripper far from Finish."""

OTHER_GAMEPAD = Profile("gamepad", ways=Ways(x=Way(axis=1, sign=-1), y=Way(axis=0, sign=-1)))
"""Of a pad whose order no standard tells only the first stick is sure: what comes after it may be a trigger."""

SPACE_MOUSE = Profile(
    "spacemouse",
    dead_zone=0.08,
    crosstalk=0.15,
    ways=Ways(
        x=Way(axis=1, sign=-1),  # as the device counts by itself: x right, y towards the hand, z down
        y=Way(axis=0, sign=-1),
        z=Way(axis=2, sign=-1),
        roll=Way(axis=4, sign=-1),
        pitch=Way(axis=3, sign=-1),
        yaw=Way(axis=5, sign=-1),
    ),
    buttons=Buttons(finish=0, store=1),
)

POINTER = Profile(
    "pointer",
    dead_zone=0.0,
    expo=0.0,
    ways=Ways(
        x=Way(axis=2, sign=-1),  # the wheel: away from the hand is forward
        y=Way(axis=0, sign=-1),
        z=Way(axis=1, sign=-1),
        roll=Way(axis=5),
        pitch=Way(axis=4),
        yaw=Way(axis=3, sign=-1),
    ),
)
"""Drag: left and up; wheel: forward; with Shift the same turns."""

PHANTOM = Profile("phantom", coupled="held", buttons=Buttons(clutch=0, store=1))
"""The hand counts while it holds the front button: a stylus that lies there asks for nothing."""
