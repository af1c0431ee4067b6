"""A path of the joints from one pose to another that touches nothing: sampled by OMPL, cut short."""

import atexit
import os

import numpy as np

from sim.planning.arm import Array, PlanningArm
from sim.pose import Pose

SEED = 1
SECONDS = 5.0
"""After which the search is given up."""

_RANGE = 0.4  # [rad] of a step of the tree
_RESOLUTION = 0.01  # of the space's extent, between two states that are checked


def path(arm: PlanningArm, start: Pose, end: Pose, clearance: float, thing_clearance: float) -> Array | None:
    """Return joint positions from one pose to another, shape (n, m); None where none were found.

    Args:
        arm: That moves, among what is arranged around it.
        start: Where the path begins.
        end: Where it ends.
        clearance: See `PlanningArm.touches` [m].
        thing_clearance: See there [m].
    """
    first, last = arm.solve(start, arm.seeds()), arm.solve(end, arm.seeds())
    if first is None or last is None:
        return None

    def is_free(q: Array) -> bool:
        return not arm.touches(q, clearance, thing_clearance)

    return _connected(arm, first, last, is_free) if is_free(first) and is_free(last) else None


def _connected(arm: PlanningArm, first: Array, last: Array, is_free: object) -> Array | None:
    # Imported here: few tasks need it.
    from ompl import base, geometric, util  # noqa: PLC0415

    _be_quiet_at_the_end()
    util.RNG.setSeed(SEED)
    util.setLogLevel(util.LogLevel.LOG_NONE)
    count = len(first)
    space, bounds = base.RealVectorStateSpace(count), base.RealVectorBounds(count)
    for joint in range(count):
        bounds.setLow(joint, float(arm.lower[joint]))
        bounds.setHigh(joint, float(arm.upper[joint]))
    space.setBounds(bounds)
    information = base.SpaceInformation(space)
    information.setStateValidityChecker(lambda state: bool(is_free(_of(state, count))))  # type: ignore[operator]
    information.setStateValidityCheckingResolution(_RESOLUTION)
    information.setup()
    problem = base.ProblemDefinition(information)
    ends = [space.allocState(), space.allocState()]
    for state, q in zip(ends, (first, last), strict=True):
        for joint in range(count):
            state[joint] = float(q[joint])
    problem.setStartAndGoalStates(*ends)
    planner = geometric.RRTConnect(information)
    planner.setRange(_RANGE)
    planner.setProblemDefinition(problem)
    planner.setup()
    if not planner.solve(SECONDS) or not problem.hasExactSolution():
        return None
    found = problem.getSolutionPath()
    geometric.PathSimplifier(information).partialShortcutPath(found)
    found.interpolate(60)
    return np.array([_of(found.getState(number), count) for number in range(found.getStateCount())])


def _of(state: object, count: int) -> Array:
    return np.array([state[joint] for joint in range(count)])  # type: ignore[index]


_silenced: list[bool] = []


def _be_quiet_at_the_end() -> None:
    """Keep the library's complaint about its own bindings, its last words, from whoever reads the terminal."""
    if not _silenced:
        _silenced.append(True)
        atexit.register(lambda: os.dup2(os.open(os.devnull, os.O_WRONLY), 2))
