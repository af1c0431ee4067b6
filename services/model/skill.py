"""What a model is learnt for, where its demonstrations lie, and which demonstrations and questions belong to it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lfd.exceptions import BoundElsewhere, OutOfRange, StorageError
from lfd.motion.demonstration import Demonstration, Situation, check_dimension
from lfd.store.database import Binding, DemonstrationStore
from services.process.config import ModelSection
from services.process.exceptions import ServiceError
from services.process.files import data_folder
from sim.tasks import AnyScene

_EARLIER = "model.sqlite"
"""Where a robot's demonstrations lay, whatever their scene, before each scene had a file of its own."""

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
        ServiceError: the file cannot be used, or holds what was learnt for something else.
    """
    try:
        if section.database:
            path = Path(section.database)
            path.parent.mkdir(parents=True, exist_ok=True)
            return _opened(path, binding)
        folder = data_folder() / robot
        folder.mkdir(exist_ok=True)
        return _earlier(folder / _EARLIER, binding) or _opened(folder / f"{binding.scene}.sqlite", binding)
    except StorageError as error:
        raise ServiceError(str(error)) from None
    except OSError as error:
        raise ServiceError(f"cannot make {error.filename}: {error.strerror}") from None


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
        OutOfReach: the motion or its target is beyond the robot's reach.
    """
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
