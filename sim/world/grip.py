"""The gripper in the simulated world: how its fingers are driven, what holds a thing between them, who touches what.

A finger's motor has a force and a speed and nothing else: it pulls with its force towards where it is told to be, and
its damping is such that it moves at its speed where nothing is in the way. All fingers move together, as by a gear.

Between fingers and things rubber holds: contacts of their own, which leave those with everything else as they were.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.robots.gripper import Finger, Gripper
from sim.world.staging import ROBOT, THING

Array = NDArray[np.float64]

_LAG = 0.05  # share of a finger's way from its goal within which it pulls less
_RUBBER = (1.2, 1.2, 0.01, 0.0005, 0.0005)  # friction along the contact's two axes, about its normal, against rolling
_DIMENSIONS = 4  # of a contact's forces: a thing does not turn about the line between the fingers either
_HARD, _STICKY = (0.010, 1.0), (0.006, 1.0)  # of a contact, along and across it; twice as soft, a thing slips 2 mm
_GEAR = (0.005, 1.0)  # time constant [s] and damping ratio with which fingers keep together


def add_fingers(spec: mujoco.MjSpec, gripper: Gripper) -> None:
    """Drive the fingers, tie them together, and let them hold what stands there.

    Args:
        spec: Of the whole world, robot and things in it.
        gripper: Of the robot.
    """
    for finger in gripper.fingers:
        spec.joint(finger.joint).armature = finger.armature
        servo = spec.add_actuator(name=finger.joint, target=finger.joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        servo.set_to_position(kp=_stiffness(finger), kv=_damping(finger, gripper))
    for finger in gripper.fingers[1:]:
        _tie(spec, finger, gripper.fingers[0])
    pads = [geom for side in _sides(spec, gripper) for geom in side.geoms if geom.contype == ROBOT]
    things = [geom for geom in spec.geoms if geom.contype == THING]
    for number, pad in enumerate(pads):
        pad.name = f"pad_{number}"  # shapes of a description have no names
        for thing in things:
            _rubber(spec, pad, thing)


class Grip:
    """The gripper of a compiled model.

    Args:
        model: That `add_fingers` was given.
        gripper: Of the robot in it.
        thing: Name of the body that it is there to hold.
    """

    def __init__(self, model: mujoco.MjModel, gripper: Gripper, thing: str) -> None:
        self._model = model
        self._gripper = gripper
        joints = [model.joint(finger.joint) for finger in gripper.fingers]
        self._q = np.array([joint.qposadr[0] for joint in joints], dtype=int)
        self._ctrl = np.array([model.actuator(finger.joint).id for finger in gripper.fingers], dtype=int)
        self._closed = np.array([finger.closed for finger in gripper.fingers])
        self._way = np.array([finger.wide - finger.closed for finger in gripper.fingers])
        self._lag = _LAG * np.abs(self._way)
        fingers = [int(model.jnt_bodyid[joint.id]) for joint in joints]
        self._sides = {*fingers, *([int(model.body(gripper.jaw).id)] if gripper.jaw else [])}
        self._thing = int(model.body(thing).id)

    def open(self, data: mujoco.MjData) -> None:
        """Put the fingers wide open, at rest."""
        data.qpos[self._q] = data.ctrl[self._ctrl] = self._closed + self._way

    def pull(self, data: mujoco.MjData, opening: float) -> None:
        """Let the fingers pull towards an opening [m] in the next step of physics."""
        q = data.qpos[self._q]
        goal = self._closed + opening / self._gripper.opening * self._way
        data.ctrl[self._ctrl] = q + np.minimum(np.maximum(goal - q, -self._lag), self._lag)

    def opening(self, data: mujoco.MjData) -> float:
        """Return how far it is open [m]."""
        if not self._q.size:
            return self._gripper.opening
        return self._gripper.opening * float(np.mean((data.qpos[self._q] - self._closed) / self._way))

    def holds(self, data: mujoco.MjData) -> bool:
        """Return whether all of its fingers, or finger and jaw, touch the thing."""
        if data.ncon == 0 or not self._q.size:
            return False
        bodies = self._model.geom_bodyid[data.contact.geom].tolist()
        touching = {one if other == self._thing else other for one, other in bodies if self._thing in (one, other)}
        return touching.issuperset(self._sides)


def _stiffness(finger: Finger) -> float:
    return finger.effort / (_LAG * abs(finger.wide - finger.closed))


def _damping(finger: Finger, gripper: Gripper) -> float:
    speed = gripper.speed / gripper.opening * abs(finger.wide - finger.closed)
    return finger.effort / speed


def _tie(spec: mujoco.MjSpec, finger: Finger, first: Finger) -> None:
    """A finger is where the first one is, in shares of their ways."""
    ratio = (finger.wide - finger.closed) / (first.wide - first.closed)
    gear = spec.add_equality(name=f"gear_{finger.joint}", type=mujoco.mjtEq.mjEQ_JOINT)
    gear.objtype = mujoco.mjtObj.mjOBJ_JOINT
    gear.name1, gear.name2 = finger.joint, first.joint
    gear.data[:2] = finger.closed - ratio * first.closed, ratio
    gear.solref = _GEAR


def _sides(spec: mujoco.MjSpec, gripper: Gripper) -> list[mujoco.MjsBody]:
    """The bodies between which a thing is held."""
    fingers = [spec.joint(finger.joint).parent for finger in gripper.fingers]
    return [*fingers, *([spec.body(gripper.jaw)] if gripper.jaw else [])]


def _rubber(spec: mujoco.MjSpec, pad: mujoco.MjsGeom, thing: mujoco.MjsGeom) -> None:
    pair = spec.add_pair(name=f"{pad.name} on {thing.name}", geomname1=pad.name, geomname2=thing.name)
    pair.condim = _DIMENSIONS
    pair.friction = _RUBBER
    pair.solref, pair.solreffriction = _HARD, _STICKY
