"""`retouch teach`: gives an empty model its first demonstrations, or a motion through waypoints, or takes one back."""

from __future__ import annotations

import logging
from argparse import ArgumentParser, Namespace
from pathlib import Path

import numpy as np

from lfd.motion.waypoints import through_waypoints
from lfd.store.waypoint_file import Surroundings, read_waypoints
from protocol import queries
from protocol.messages import Method, ModelState, Purpose, Vector3
from protocol.queries import AddDemonstration, Undo
from services.bus.arrays import motion_to_wire, vector3
from services.bus.identity import new_number
from services.commands.arguments import add_network, add_scene, position, within
from services.commands.model_process import ANSWER_S, ModelProcess, model_process
from services.commands.settings import configuration as configured
from services.model.skill import binding_of
from services.model.skills import is_own
from services.offline.first_demonstrations import first_demonstrations
from services.process.config import Configuration
from services.process.exceptions import CommandFailed
from services.process.robots import scene_of
from sim.tasks import REACHING, AnyScene

log = logging.getLogger(__name__)

MODEL_WITHIN_S = 60.0

TAUGHT_S = 10.0
"""Duration of a motion through waypoints, unless told otherwise: the thesis' time of an autonomous execution."""

LONGEST_S = 3600.0
"""Duration of the longest motion that a message carries."""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = (
        "Teaches an empty model its first demonstrations, or a model a motion through waypoints,\n"
        "or takes back what it learnt last."
    )
    add_network(parser)
    add_scene(parser)
    parser.add_argument(
        "--waypoints",
        type=Path,
        metavar="FILE",
        help="CSV with the columns x,y,z,qw,qx,qy,qz: poses of the gripper in the base frame [m], at least three rows",
    )
    parser.add_argument(
        "--object",
        type=position,
        metavar="X,Y,Z",
        help="where the waypoints lead to, base frame [m]; write --object=-X,Y,Z where the first is negative",
    )
    parser.add_argument("--undo", action="store_true", help="take back what the model learnt last, and teach nothing")
    seconds = within(0.0, LONGEST_S, "seconds", above=True)
    parser.add_argument("--duration", type=seconds, metavar="S", help=f"of the motion [s] (default: {TAUGHT_S:g})")


def run(arguments: Namespace) -> int:
    """See `Action`."""
    settings = configured(arguments)
    given = [flag for flag in ("waypoints", "object", "duration") if getattr(arguments, flag) is not None]
    if arguments.undo:
        if given:
            raise CommandFailed(f"--undo teaches nothing: leave out --{given[0]}, or --undo")
        take_back(settings)
    elif not given:
        teach(settings)
    elif not {"waypoints", "object"} <= set(given):
        raise CommandFailed(f"--{given[0]} alone teaches nothing: give --waypoints FILE and --object X,Y,Z")
    else:
        teach_waypoints(settings, arguments.waypoints, arguments.object, arguments.duration or TAUGHT_S)
    return 0


def teach(configuration: Configuration) -> None:
    """Give the model its first demonstrations, where it has none.

    Raises:
        ServiceError: there is no model to teach, it is for another scene, or no motion could be taught.
    """
    scene = scene_of(configuration.robot)
    # Taught before the bus is there: nothing waits for it, and Ctrl-C ends it at once.
    demonstrations = first_demonstrations(scene)
    with model_process(configuration, "teach") as model:
        state = _held(model, scene, MODEL_WITHIN_S)
        if not is_own(configuration.model, binding_of(scene), state.skill):
            log.info("skill %r is left to whoever teaches it", state.skill)
            return
        if state.updates or state.demonstrations >= len(demonstrations):
            log.info("the model has %d demonstrations and %d updates", state.demonstrations, state.updates)
            return
        # What an earlier run that was killed has given already is not given again.
        for demonstration in demonstrations[state.demonstrations :]:
            taught = demonstration.trajectory
            motion = motion_to_wire(taught.positions, taught.orientations, taught.duration, taught.opening)
            condition = tuple(demonstration.condition.tolist())
            origin = vector3(demonstration.origin)
            given = AddDemonstration(Purpose.INITIAL, motion, origin, scene.name, condition, request=new_number())
            _learnt(model, given)
    log.info("taught %d demonstrations of %s", len(demonstrations), scene.name)


def teach_waypoints(configuration: Configuration, file: Path, object_position: Vector3, duration: float) -> None:
    """Add the motion through a file's waypoints to what the model has learnt (OffKey, the teach pendant's method).

    Args:
        configuration: whose scene the motion is for.
        file: see `read_waypoints`.
        object_position: that the motion reaches, base frame [m].
        duration: of the motion [s].

    Raises:
        ServiceError: the scene has no object, or there is no model that takes the motion.
        LfdError: the file cannot be used, or the duration is not positive.
        SimError: there is no such scene, or no object of it can be there.
    """
    # All that a person can have got wrong shows before the network is asked for anything.
    scene = scene_of(configuration.robot)
    if not scene.has_object:
        raise CommandFailed(f"scene {scene.name} has no object that waypoints lead to: use {' or '.join(REACHING)}")
    target, reach = np.array(object_position), scene.robot.reach
    scene.check_place(target, scene.margin)
    waypoints = read_waypoints(file, Surroundings(np.array(reach.lower), np.array(reach.upper), target))
    taught = through_waypoints(waypoints.positions, waypoints.orientations, duration, opening=waypoints.opening)
    motion = motion_to_wire(taught.positions, taught.orientations, taught.duration, taught.opening)
    with model_process(configuration, "teach") as model:
        before = _held(model, scene)
        purpose = Purpose.UPDATE if before.demonstrations or before.updates else Purpose.INITIAL
        given = AddDemonstration(
            purpose,
            motion,
            object_position,
            scene.name,
            operator=configuration.operator,
            method=Method.WAYPOINTS,
            request=new_number(),
        )
        state = _learnt(model, given)
    log.info("taught a motion through %d waypoints; %s", len(waypoints.positions), _holds(state))


def take_back(configuration: Configuration) -> None:
    """Take back the newest update, or the newest first demonstration where there is no update.

    Raises:
        ServiceError: there is no model, it is for another scene, or it has nothing to take back.
        SimError: there is no such scene.
    """
    scene = scene_of(configuration.robot)
    with model_process(configuration, "teach") as model:
        before = _held(model, scene)
        purpose = Purpose.UPDATE if before.updates else Purpose.INITIAL
        given = Undo(purpose=purpose, operator=configuration.operator, request=new_number())
        state = model.ask(queries.UNDO, given, "take it back").state
    taken = "update" if purpose is Purpose.UPDATE else "first demonstration"
    log.info("took back the newest %s; %s", taken, _holds(state))


def _holds(state: ModelState) -> str:
    return f"the model has {state.demonstrations} demonstrations and {state.updates} updates"


def _held(model: ModelProcess, scene: AnyScene, within_s: float = ANSWER_S) -> ModelState:
    """What the model holds; raises CommandFailed where it is for another scene or robot, else as `ModelProcess`."""
    state = model.state(within_s)
    wanted, kind = binding_of(scene)
    if (state.scene, state.robot_kind) != (wanted, kind):
        raise CommandFailed(
            f"the running model is for scene {state.scene} with robot {state.robot_kind},"
            f" not for scene {wanted} with robot {kind}:"
            f" start it with --scene {wanted}, or teach with --scene {state.scene}"
        )
    return state


def _learnt(model: ModelProcess, request: AddDemonstration) -> ModelState:
    return model.ask(queries.ADD_DEMONSTRATION, request, "learn it").state
