"""The configuration that a command's flags make."""

from __future__ import annotations

import logging
from argparse import Namespace
from typing import Any

import msgspec

from protocol.names import checked_name
from services.certificates.credentials import check_secured, is_open, present
from services.commands.sides import placed, reachable
from services.process.config import Configuration, RobotSection, load
from services.process.master_devices import Scripted
from services.process.processes import PROCESSES

log = logging.getLogger(__name__)

OPEN = "this network is open to others (--insecure): whoever reaches it can listen in and command"

_FLAGS = {
    "robot": "name",
    "operator": "operator",
    "connect": "connect",
    "listen": "listen",
    "tls": "tls",
    "seed": "seed",
}
"""Flag to the key that it stands for."""

_ROBOT_FLAGS = {"task": "scene", "robot_model": "model"}
"""The same, of the robot's section."""

_BACKEND_FLAGS = {"backend": "kind", "backend_host": "host"}
"""The same, of what moves it."""

_STATION_FLAGS = {"headless": "scripted", "once": "once", "untaught": "untaught", "variant": "variant"}
"""The same, of the station's section."""


def configuration(arguments: Namespace) -> Configuration:
    """The configuration file, where one was given, with the flags on top.

    Raises:
        ConfigurationError: the file cannot be used.
        ProtocolError: the robot's or operator's name cannot stand in a message.
        SimError: there is no such scene, or it has no such variant.
        UnusableSetting: a side of the network is to be started, and the file does not say where the other one is.
        Unsecured: an endpoint is open to others, and nobody said that it may be.
    """
    given = {flag: value for flag, value in vars(arguments).items() if value is not None}
    result = load(arguments.config) if "config" in given else Configuration()
    if "side" in given:
        result = placed(result, given["side"]).configuration
    changes: dict[str, object] = {key: given[flag] for flag, key in _FLAGS.items() if flag in given}
    if "listen" in given and "connect" not in given:
        changes["connect"] = reachable(given["listen"])
    if given.get("insecure"):
        changes["insecure"] = True
    robot = _robot(given, result.robot)
    if robot:
        changes["robot"] = msgspec.structs.replace(result.robot, **robot)
    if given.get("headless"):
        changes["master"] = msgspec.structs.replace(result.master, device=Scripted())
    station = {key: given[flag] for flag, key in _STATION_FLAGS.items() if flag in given}
    if "skill" in given:
        changes["model"] = msgspec.structs.replace(result.model, skill=given["skill"])
    result = msgspec.structs.replace(result, station=msgspec.structs.replace(result.station, **station), **changes)
    files = {"model": result.robot.model_file, "scene": result.robot.task_file}
    paths = {key: str(file.absolute()) for key, file in files.items() if file is not None}
    if paths:  # named as every process finds them
        result = msgspec.structs.replace(result, robot=msgspec.structs.replace(result.robot, **paths))
    if result.station.variant or robot:
        # Imported here: few name a scene, a robot or a variant, and only they need the scenes.
        from services.process.robots import scene_of  # noqa: PLC0415

        found = scene_of(result.robot)
        if result.station.variant:
            found.check(result.station.variant)
    checked_name(result.name)
    for process in PROCESSES:
        checked_name(process.named(checked_name(result.operator)))
    for endpoint in (result.connect, result.listen):
        check_secured(result, endpoint)
    result = msgspec.structs.replace(result, operator=present(result))
    if is_open(result):
        log.warning(OPEN)
    return result


def _robot(given: dict[str, Any], section: RobotSection) -> dict[str, Any]:
    """What the flags change of the robot's section."""
    changes = {key: given[flag] for flag, key in _ROBOT_FLAGS.items() if flag in given}
    backend = {key: given[flag] for flag, key in _BACKEND_FLAGS.items() if flag in given}
    return changes | ({"backend": msgspec.structs.replace(section.backend, **backend)} if backend else {})
