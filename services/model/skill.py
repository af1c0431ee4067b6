"""What a model is learnt for, where its demonstrations lie, and which demonstrations and questions belong to it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lfd.exceptions import BoundElsewhere, OutOfRange, StorageError
from lfd.motion.demonstration import Demonstration, Situation, check_dimension
from lfd.motion.trajectory import Trajectory
from lfd.store.database import DemonstrationStore
from lfd.store.stored import Binding
from services.process.config import ModelSection
from services.process.exceptions import CannotWrite
from services.process.files import data_folder, make_folder
from sim.robots.catalogue import DEFAULT_NAME
from sim.robots.robot import PARTICLE
from sim.tasks import AnyScene

_EARLIER = "model.sqlite"
"""Where a robot's demonstrations lay, whatever their scene, before each scene had a file of its own."""

SHORTEST_S, LONGEST_S = 0.1, 3600.0
"""Of a robot's motion: no arm is faster, and no message carries a longer one."""

_CONDITION_WITHIN = 5.0  # [m] no object is farther from where a motion starts, no via-point from the origin


def binding_of(scene: AnyScene) -> Binding:
    """What is learnt in a scene is good for it and for the robot that moves in it."""
    return Binding(scene.name, scene.robot.kind)


def open_store(section: ModelSection, robot: str, binding: Binding) -> DemonstrationStore:
    """The demonstrations of a skill: in the configured file, or in one of its own in the user's data folder.

    Args:
        section: of the configuration.
        robot: its name on the network.
        binding: what the skill is for.

    Raises:
        StorageError: the file cannot be used, or holds what was learnt for something else.
        EnvironmentFault: its folder cannot be made or written.
    """
    if section.database:
        path = Path(section.database)
        _make(path.parent)
        return _opened(path, binding)
    folder = data_folder() / robot
    _make(folder)
    return _earlier(folder / _EARLIER, binding) or _opened(folder / f"{_stem(binding)}.sqlite", binding)


def _stem(binding: Binding) -> str:
    """Of a skill's file: what one robot has learnt in a scene lies beside what another one has."""
    ours = binding.robot in (DEFAULT_NAME, PARTICLE.kind)
    return binding.scene if ours else f"{binding.scene}-{binding.robot}"


def _make(folder: Path) -> None:
    try:
        make_folder(folder)
    except OSError as error:
        raise CannotWrite(folder, error.strerror or str(error)) from None


def _opened(path: Path, binding: Binding) -> DemonstrationStore:
    store = DemonstrationStore(path)
    try:
        store.check(binding)
    except StorageError:
        store.close()
        raise
    return store


def _earlier(path: Path, binding: Binding) -> DemonstrationStore | None:
    """The file in which an earlier version kept all that a robot learnt, where that is what is wanted."""
    if not path.is_file():
        return None
    try:
        store = _opened(path, binding)
    except BoundElsewhere:
        return None
    if store.active():
        return store
    store.close()
    return None


def check_demonstration(scene: AnyScene, demonstration: Demonstration) -> None:
    """Let pass a motion that the scene's robot can have made: a model learns from anything else for ever.

    Args:
        scene: that the skill is for.
        demonstration: to be learnt.

    Raises:
        OutOfRange: it is too fast or too slow for a robot.
        OutOfReach: the motion or its target is beyond the robot's reach.
    """
    check_duration("the motion's duration", demonstration.trajectory)
    scene.robot.check("the motion passes", demonstration.trajectory.positions)
    check_situation(scene, demonstration.situation)


def check_situation(scene: AnyScene, situation: Situation) -> None:
    """Let pass what the robot can be asked for in a scene; see `check_demonstration`.

    Raises:
        OutOfReach: the start or the target is beyond the robot's reach.
        WrongShape: the condition has not as many numbers as the scene's.
        OutOfRange: it is larger than any that the scene has.
    """
    scene.robot.check("the motion starts at", situation.start_position[None])
    scene.robot.check("the target at", situation.origin[None])
    check_dimension(situation.condition, len(scene.region.lower))
    furthest = float(np.max(np.abs(situation.condition)))
    if furthest > _CONDITION_WITHIN:
        raise OutOfRange("the condition's largest number", furthest, f"at most {_CONDITION_WITHIN:g} m")


def check_duration(what: str, motion: Trajectory) -> None:
    """Let pass a motion that takes as long as a robot's can.

    Args:
        what: its duration is called in an error.
        motion: taught or predicted.

    Raises:
        OutOfRange: it takes less or more.
    """
    if not SHORTEST_S <= motion.duration <= LONGEST_S:
        raise OutOfRange(what, motion.duration, f"from {SHORTEST_S:g} to {LONGEST_S:g} s")
