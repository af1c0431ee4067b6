"""`retouch run`: executes a skill again and again at drawn places, and says how often it succeeds."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

import msgspec

from services.commands.arguments import add_network, add_scene, whole
from services.commands.settings import configuration
from services.commands.skill.changing import use
from services.commands.up.launch import Launch, check_report, launch
from services.model.exceptions import SkillMisfit
from services.model.skill import binding_of
from services.model.skills import shelf_of
from services.process.config import Configuration
from services.process.exceptions import CommandFailed
from services.process.master_devices import Scripted
from services.process.processes import PROCESS_NAMES
from services.process.robots import scene_of
from sim.robots.catalogue import DEFAULT_NAME, NAMES

MOST = 10_000

_ABOUT = """\
Executes a skill N times, each time with the target at another place, and teaches nothing.
You command while it runs, by a script that presses Execute: it holds the authority, and
a stop, from any page or by 'retouch stop', ends it at once. At the end stand how many
succeeded, with a 95 % interval, why the others failed, and how long they took. All N
executed is exit code 0, whatever came of them.

Everything is started on this machine, for the task and the robot that the skill is for.
With --connect only a station is, which joins the robot there and has its model use the
skill.
"""

_EXAMPLES = """\
examples:
  retouch run cups --times 20                 twenty times, at drawn places
  retouch run cups --times 20 --seed 7 --json cups.json
  retouch run cups --times 5 --operator anna --connect tls/192.0.2.1:7447
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.add_argument("skill", metavar="SKILL", help="by its name; see 'retouch skill list'")
    parser.add_argument("--times", type=whole(1), default=10, metavar="N", help="how often (default: 10)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write what happened")
    add_network(parser)
    add_scene(parser)
    parser.description, parser.epilog = _ABOUT, _EXAMPLES


def run(arguments: Namespace) -> int:
    """See `Action`.

    Raises:
        SkillError: there is no such skill, or it is for something else.
        CommandFailed: it has learnt nothing, or something else has to be said.
        ServiceError: the run cannot start.
    """
    if arguments.times > MOST:
        raise CommandFailed(f"--times {arguments.times}: give {MOST} at most")
    if arguments.json is not None:
        check_report(arguments.json)
    # Which variants there are, the skill's task says, which is not known before.
    variant, arguments.variant = arguments.variant, None
    settings = configuration(arguments)
    here = arguments.connect is None
    if here:
        settings = fitted(settings, arguments.skill, task=arguments.task, model=arguments.robot_model)
        if variant is not None:
            scene_of(settings.robot).check(variant)
    else:
        held = use(settings, arguments.skill)
        if arguments.task is None:
            robot = msgspec.structs.replace(settings.robot, scene=held.scene)
            settings = msgspec.structs.replace(settings, robot=robot)
        if not (held.demonstrations or held.updates):
            raise CommandFailed(f"skill {arguments.skill} has learnt nothing yet: teach it first")
    executing = Launch(
        processes=PROCESS_NAMES if here else ("station",),
        router=here,
        headless=True,
        once=True,
        untaught=True,
        json=arguments.json,
        page=False,
        browser=False,
    )
    return launch(executed(settings, arguments.skill, arguments.times, variant or ""), executing)


def fitted(settings: Configuration, name: str, *, task: str | None, model: str | None) -> Configuration:
    """The configuration for the task and the robot that a skill of this machine is for, as far as nothing else is said.

    Args:
        settings: as they are.
        name: of the skill.
        task: that was asked for; None for the skill's own.
        model: the robot that was asked for; None for the skill's own.

    Raises:
        SkillError: there is no such skill, or it is for something else.
        CommandFailed: it cannot be used, or has learnt nothing.
        SimError: the skill's task is not there by its name.
    """
    skill = shelf_of(settings.model, settings.name).find(name)
    if skill.fault:
        raise CommandFailed(f"skill {name}: {skill.fault}")
    if skill.about is None or not sum(skill.counts):
        raise CommandFailed(f"skill {name} has learnt nothing yet: teach it first")
    held = skill.about.binding
    robot = settings.robot
    if task is None:
        robot = msgspec.structs.replace(robot, scene=held.scene)
    if model is None and held.robot in NAMES and held.robot != DEFAULT_NAME:
        robot = msgspec.structs.replace(robot, model=held.robot)
    wanted = binding_of(scene_of(robot))
    if not held.fits(wanted):
        raise SkillMisfit(name, held, wanted)
    return msgspec.structs.replace(settings, robot=robot)


def executed(settings: Configuration, name: str, times: int, variant: str) -> Configuration:
    """The configuration of a run that executes a skill and teaches nothing."""
    station = settings.station
    chosen = variant or station.variant
    return msgspec.structs.replace(
        settings,
        model=msgspec.structs.replace(settings.model, skill=name),
        master=msgspec.structs.replace(settings.master, device=Scripted()),
        station=msgspec.structs.replace(station, scripted=True, once=True, executions=times, variant=chosen),
    )
