"""What there is to know of a task before it is started: what is missing, which way leads through it, where to stand."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from services.bus.arrays import vector3
from services.commands.task.bases import Placements, placements
from services.process.config import RobotSection
from services.process.exceptions import UnusableSetting
from services.process.exit_codes import Exit
from services.process.files import write_file
from services.process.robots import scene_of
from sim.exceptions import NoWay
from sim.planning.arm import PlanningArm
from sim.planning.ways import places
from sim.robots.robot import Base
from sim.tasks import REACHING
from sim.tasks.reaching import ReachingScene
from sim.tasks.task_file import faults
from sim.world.pictures import png
from sim.world.portrait import Dot, scenery

_GREEN, _AMBER, _GREY = (0.10, 0.60, 0.25, 1.0), (0.90, 0.65, 0.15, 1.0), (0.55, 0.57, 0.60, 0.6)
_BLUE = (0.13, 0.42, 0.78, 1.0)


def listed() -> int:
    """Print the tasks that ship, a line each."""
    for name, task in REACHING.items():
        _say(f"{name}: {task.about} ({', '.join(task.variants)})")
    return Exit.DONE


def check(which: str, robot: str, folder: Path) -> int:
    """Print what is missing; where nothing is, what was found, and draw the picture.

    Args:
        which: task, by name or file.
        robot: that stands in it; the default one where it is empty.
        folder: for the picture.
    """
    file = RobotSection(scene=which).task_file
    missing = [] if file is None else faults(file)
    for line in missing:
        _say(line)
    if missing:
        return Exit.BAD_INPUT
    task = _task(which, robot)
    if not _reaches_start(task):
        _say(f"start: {task.manipulator.kind} does not reach it from where it stands")
        return Exit.BAD_INPUT
    outside = _unreached(task)
    for place in outside:
        _say(f"region: {task.manipulator.kind} does not reach an object at {_told(place)}")
    try:
        dots = _ways(task)
    except NoWay as error:
        _say(str(error))
        return Exit.BAD_INPUT
    found = placements(task)
    _say(_advice(task, found))
    pairs = zip(found.bases, found.shares.tolist(), strict=True)
    bases = [Dot(vector3(base), _GREEN if share > 1.0 - 1e-9 else _GREY) for base, share in pairs]
    _write(task, folder, [*dots, *bases])
    return Exit.BAD_INPUT if outside else Exit.DONE


def draw(which: str, robot: str, folder: Path) -> int:
    """Draw the picture alone; arguments as of `check`."""
    task = _task(which, robot)
    _write(task, folder, _corners(task))
    return Exit.DONE


def _task(which: str, robot: str) -> ReachingScene:
    """The task that is meant, its robot in it.

    Raises:
        UnusableSetting: none is named, or one without an arm.
    """
    found = scene_of(RobotSection(scene=which, model=robot)) if which else None
    if not isinstance(found, ReachingScene):
        what = "name a task" if found is None else f"{found.name} is no task of an arm"
        raise UnusableSetting("retouch task", f"{what}: one of {', '.join(REACHING)}, or a file")
    return found


def _reaches_start(task: ReachingScene) -> bool:
    arm = PlanningArm(task)
    return arm.solve(task.start, arm.seeds()) is not None


def _unreached(task: ReachingScene) -> list[np.ndarray]:
    """Corners of the region that lie out of the robot's reach, whatever it does."""
    low, high = np.array(task.robot.reach.lower), np.array(task.robot.reach.upper)
    return [place for place in places(task) if not np.all((low <= place) & (place <= high))]


def _ways(task: ReachingScene) -> list[Dot]:
    """Say which way leads through each variant; what is drawn of them."""
    place = task.training_positions[0]
    before, after = (task.corridor(variant, place).positions for variant in task.variants)
    how = "drawn in the file" if task.is_drawn else f"found for {task.manipulator.kind}"
    apart = float(np.linalg.norm(after - before, axis=1).max())
    _say(f"ways: {how}; the one through {task.variants[1]} is {100.0 * apart:.0f} cm beside the other at most")
    if apart == 0.0:
        _say(f"ways: what is learnt in {task.variants[0]} does in {task.variants[1]}, too: nothing is to be corrected")
    return [*_corners(task), *(Dot(vector3(one), _AMBER) for one in after)]


def _corners(task: ReachingScene) -> list[Dot]:
    return [Dot(vector3(place), _BLUE) for place in places(task)]


def _advice(task: ReachingScene, found: Placements) -> str:
    """Where the base should stand."""
    here = (task.stance.base or Base()).position
    share = found.shares[np.argmin(np.linalg.norm(found.bases - np.array(here), axis=1))]
    said = f"base: from {_told(np.array(here))} {share:.0%} of start and region are reached"
    best, whole = found.best, int(np.count_nonzero(found.shares > 1.0 - 1e-9))
    if best is None:
        top = found.bases[np.argmax(found.shares)]
        return f"{said}; all from no place within 0.3 m of it, {found.shares.max():.0%} from {_told(top)}"
    return f"{said}; all from {whole} of {len(found.bases)} places round it, best {_told(best)}"


def _told(place: np.ndarray) -> str:
    return f"[{', '.join(f'{value:.2f}' for value in place.tolist())}]"


def _write(task: ReachingScene, folder: Path, dots: Sequence[Dot]) -> None:
    for variant in task.variants:
        path = folder / f"{task.name}-{variant}.png"
        write_file(path, png(scenery(task, variant, dots)))
        _say(f"written: {path}")


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()
