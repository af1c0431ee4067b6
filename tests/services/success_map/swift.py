"""Motions in less time: there is less to simulate."""

from dataclasses import replace

from services.offline.first_demonstrations import first_demonstrations


def swift(motion):
    """The same in less time: there is less to simulate."""
    return replace(motion, duration=4.0)


def shown_swiftly(scene):
    """The scene's first demonstrations, in less time."""
    return [replace(one, trajectory=swift(one.trajectory)) for one in first_demonstrations(scene)]
