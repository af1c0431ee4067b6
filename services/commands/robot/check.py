"""What there is to know of a robot before it is started: what is missing, how it stands, where it can grasp."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from services.bus.arrays import vector3
from services.commands.robot.grasps import grasps
from services.process.config import RobotSection
from services.process.exit_codes import Exit
from services.process.files import write_file
from services.process.robot_file import load_robot
from services.process.robots import manipulator
from services.robot.kinematics import Kinematics
from services.robot.starts import StartImpossible, Starts
from sim.robots import faults
from sim.robots.catalogue import DEFAULT, NAMES, robot
from sim.robots.description import prepare, source_of
from sim.robots.robot import Base, Manipulator
from sim.tasks import REACHING, described
from sim.world.pictures import png
from sim.world.portrait import Dot, portrait

SAFE = 0.02
"""Between a robot's parts at home [m]: less is told."""

_COLOURS = {True: (0.10, 0.60, 0.25, 1.0), False: (0.90, 0.65, 0.15, 1.0)}


def listed() -> int:
    """Print the robots that ship, a line each."""
    for name in NAMES:
        one = robot(name)
        (x0, _, z0), (x1, _, z1) = one.reach.lower, one.reach.upper
        soft = ", orientation soft" if one.turn_slack else ""
        note = " (default)" if one is DEFAULT else ""
        _say(f"{name}{note}: {len(one.joints)} joints{soft}, reaches from {x0:g} to {x1:g} m, {z0:g} to {z1:g} m high")
    return Exit.DONE


def check(which: str, folder: Path) -> int:
    """Print what is missing; where nothing is, what was measured, and draw both pictures.

    Args:
        which: robot, by name or file; the default one where it is empty.
        folder: for the pictures.
    """
    file = RobotSection(model=which).model_file
    one = _robot(which) if file is None else load_robot(file)
    source = source_of(one)
    missing = list(faults.found(faults.parsed(source), one, source))
    for line in missing:
        _say(line)
    if missing:
        return Exit.BAD_INPUT
    wrong = _measure(one)
    _write(folder / f"{one.kind}.png", one)
    if wrong:
        return Exit.BAD_INPUT
    _look_round(one)
    found = grasps(one)
    _say(f"grasps forward and down at {found.share:.0%} of the places that it reaches at all")
    pairs = zip(found.places, found.fine.tolist(), strict=True)
    _write(folder / f"{one.kind}-reach.png", one, [Dot(vector3(place), _COLOURS[fine]) for place, fine in pairs])
    return Exit.DONE


def draw(which: str, folder: Path) -> int:
    """Draw the home posture with its frames; arguments as of `check`."""
    one = _robot(which)
    _write(folder / f"{one.kind}.png", one)
    return Exit.DONE


def _robot(which: str) -> Manipulator:
    return manipulator(RobotSection(model=which)) or DEFAULT


def _measure(one: Manipulator) -> bool:
    """Say how it stands at home and how far it reaches; whether home or the box of the reach is wrong."""
    home = np.array(one.home)
    arm = Kinematics(prepare(robot=replace(one, base=Base())).urdf, home, one)
    wrong = False
    for name, q, low, high in zip(one.joint_names, one.home, arm.lower, arm.upper, strict=True):
        if not low < q < high:
            _say(f"home: joint {name} at {q:g} is outside its limits, {low:g} to {high:g}")
            wrong = True
    distance = arm.self_distance(home)
    if distance < SAFE:
        _say(f"home: the robot is within {1e3 * distance:.0f} mm of itself; give another posture")
        wrong = True
    rng = np.random.default_rng(0)
    places = np.array([arm.forward(rng.uniform(arm.lower, arm.upper)).position for _ in range(5000)])
    lower, upper = np.floor(10.0 * places.min(axis=0) - 0.5) / 10.0, np.ceil(10.0 * places.max(axis=0) + 0.5) / 10.0
    _say(f"reach: lower = {lower.round(1).tolist()}, upper = {upper.round(1).tolist()} m from its first link")
    box = one.reach
    if not (np.all(box.lower <= places) and np.all(places <= box.upper)):
        _say(f"reach: it goes beyond {list(box.lower)} to {list(box.upper)} m: write what was measured")
        wrong = True
    return wrong


def _look_round(one: Manipulator) -> None:
    """Say which scenes it can start in."""
    for name in REACHING:
        _say(f"scene {name}: {_start(one, name)}")


def _start(one: Manipulator, name: str) -> str:
    """Whether it reaches a scene's start."""
    place = replace(REACHING[name], manipulator=one)
    arm = Kinematics(described(place).urdf, place.posture, one)
    try:
        Starts(arm, place.start, place.posture, RobotSection().self_distance_stop).joints(place.start)
    except StartImpossible as error:
        return str(error)
    return "it reaches the start"


def _write(path: Path, one: Manipulator, dots: Sequence[Dot] = ()) -> None:
    write_file(path, png(portrait(one, dots=dots)))
    _say(f"written: {path}")


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()
