"""Where the robot touches its environment, and how near it is to doing so."""

from collections.abc import Iterable
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.world.staging import ENVIRONMENT, ROBOT

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Contact:
    """One point at which the robot touches its environment.

    Neither the object, which is there to be touched, nor the floor, nor the robot itself counts
    (thesis, Appendix E).

    Attributes:
        position: In the base frame, shape (3,) [m].
        force: Magnitude [N].
        push: The same as a vector, of the environment on the robot, in the base frame, shape (3,) [N].
        robot_geom: Name of the robot's link.
        environment_geom: Name of the box, without its variant.
    """

    position: Array
    force: float
    push: Array
    robot_geom: str
    environment_geom: str


def collisions(model: mujoco.MjModel, data: mujoco.MjData) -> tuple[Contact, ...]:
    """Return the contacts between robot and environment in the current state."""
    if data.ncon == 0:
        return ()
    # Asked at every substep: a list of a few numbers is gone through faster than an array.
    types = model.geom_contype[data.contact.geom].tolist()
    hits = [i for i, (first, second) in enumerate(types) if first | second == ROBOT | ENVIRONMENT]
    return tuple(_contact(model, data, i) for i in hits)


def strongest(found: Iterable[Contact]) -> tuple[Contact, ...]:
    """Return of each link and box that met the contact with the largest force, in the order in which they met."""
    kept: dict[tuple[str, str], Contact] = {}
    for contact in found:
        pair = contact.robot_geom, contact.environment_geom
        if pair not in kept or contact.force > kept[pair].force:
            kept[pair] = contact
    return tuple(kept.values())


def _contact(model: mujoco.MjModel, data: mujoco.MjData, index: int) -> Contact:
    wrench = np.zeros(6)
    mujoco.mj_contactForce(model, data, index, wrench)
    first, second = data.contact.geom[index]
    # In the contact's own axes, as the first geom pushes the second.
    on_second = wrench[:3] @ data.contact.frame[index].reshape(3, 3)
    is_first = model.geom_contype[first] == ROBOT
    robot, environment = (first, second) if is_first else (second, first)
    return Contact(
        position=data.contact.pos[index].copy(),
        force=float(np.linalg.norm(wrench[:3])),
        push=-on_second if is_first else on_second,
        robot_geom=_link_name(model, robot),
        environment_geom=model.geom(environment).name.partition("/")[2],
    )


def clearance(model: mujoco.MjModel, data: mujoco.MjData, limit: float) -> tuple[float, str, str]:
    """Return the smallest distance between robot and environment.

    Args:
        model: The model.
        data: A state whose positions are up to date.
        limit: Distance beyond which it need not be exact [m].

    Returns:
        Distance [m], at most `limit`, and the names of the nearest link and box ("" beyond the limit).
    """
    nearest = (limit, "", "")
    robot = np.flatnonzero(model.geom_contype == ROBOT)
    environment = np.flatnonzero(model.geom_contype == ENVIRONMENT)
    for link in robot:
        for box in environment:
            distance = mujoco.mj_geomDistance(model, data, link, box, nearest[0], None)
            if distance < nearest[0]:
                nearest = (distance, _link_name(model, link), model.geom(box).name.partition("/")[2])
    return nearest


def _link_name(model: mujoco.MjModel, geom: np.integer | int) -> str:
    return str(model.body(model.geom_bodyid[geom]).name)
