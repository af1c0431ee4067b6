"""`retouch teach`: gives an empty model its first demonstrations, or a model a motion through waypoints."""

from __future__ import annotations

import logging
import threading
from pathlib import Path
from typing import TypeVar

import msgspec

from lfd.motion.waypoints import through_waypoints
from protocol import queries
from protocol.messages import Vector3
from protocol.queries import AddDemonstration, Kind, Learnt, Query
from services.bus.arrays import motion_to_wire, vector3
from services.bus.bus import Failed
from services.bus.zenoh import ZenohBus, connect
from services.commands.waypoint_file import read_waypoints
from services.offline.first_demonstrations import first_demonstrations
from services.process.clock import SystemClock
from services.process.config import Configuration
from services.process.exceptions import CommandFailed
from services.process.runner import stop_on_signals
from sim.tasks import SCENES
from sim.tasks import scene as find_scene

log = logging.getLogger(__name__)

Req = TypeVar("Req", bound=msgspec.Struct)

ANSWER_S = 10.0
MODEL_WITHIN_S = 60.0


def prepare_all() -> None:
    """Make and keep what every run needs: the simulated robot, and the first demonstrations of all scenes.

    Raises:
        ServiceError: no motion could be taught.
        SimError: the robot's packages are not installed.
    """
    for scene in SCENES.values():
        first_demonstrations(scene)
    log.info("the simulated robot and %d scenes are ready", len(SCENES))


def teach(configuration: Configuration) -> None:
    """Give the model its first demonstrations, where it has none.

    Raises:
        ServiceError: there is no model to teach, or no motion could be taught.
    """
    # Taught before the bus is there: nothing waits for it, and Ctrl-C ends it at once.
    demonstrations = first_demonstrations(find_scene(configuration.robot.scene))
    stop = stop_on_signals()
    bus = connect(configuration.connect, configuration.name, "teach", SystemClock())
    try:
        state = _answered(bus, queries.DESCRIBE, queries.Describe(), stop, MODEL_WITHIN_S).state
        if state.updates or state.demonstrations >= len(demonstrations):
            log.info("the model has %d demonstrations and %d updates", state.demonstrations, state.updates)
            return
        # What an earlier run that was killed has given already is not given again.
        for demonstration in demonstrations[state.demonstrations :]:
            taught = demonstration.trajectory
            motion = motion_to_wire(taught.positions, taught.orientations, taught.duration)
            request = AddDemonstration(
                Kind.INITIAL,
                motion,
                vector3(demonstration.origin),
                configuration.robot.scene,
                tuple(demonstration.condition.tolist()),
            )
            _answered(bus, queries.ADD_DEMONSTRATION, request, stop)
        log.info("taught %d demonstrations of %s", len(demonstrations), configuration.robot.scene)
    finally:
        bus.close()


def teach_waypoints(configuration: Configuration, file: Path, object_position: Vector3, duration: float) -> None:
    """Add the motion through a file's waypoints to what the model has learnt (OffKey, the teach pendant's method).

    Args:
        configuration: whose scene the motion is for.
        file: see `read_waypoints`.
        object_position: that the motion reaches, base frame [m].
        duration: of the motion [s].

    Raises:
        ServiceError: the file cannot be used, or there is no model that takes the motion.
        LfdError: the duration is not positive.
        SimError: there is no such scene.
    """
    # All that a person can have got wrong shows before the network is asked for anything.
    waypoints = read_waypoints(file)
    taught = through_waypoints(waypoints.positions, waypoints.orientations, duration)
    motion = motion_to_wire(taught.positions, taught.orientations, taught.duration)
    scene = find_scene(configuration.robot.scene).name
    stop = stop_on_signals()
    bus = connect(configuration.connect, configuration.name, "teach", SystemClock())
    try:
        before = _answered(bus, queries.DESCRIBE, queries.Describe(), stop).state
        kind = Kind.UPDATE if before.demonstrations or before.updates else Kind.INITIAL
        request = AddDemonstration(kind, motion, object_position, scene)
        state = _answered(bus, queries.ADD_DEMONSTRATION, request, stop).state
    finally:
        bus.close()
    log.info(
        "taught a motion through %d waypoints; the model has %d demonstrations and %d updates",
        len(waypoints.positions),
        state.demonstrations,
        state.updates,
    )


def _answered(
    bus: ZenohBus, query: Query[Req, Learnt], request: Req, stop: threading.Event, within_s: float = ANSWER_S
) -> Learnt:
    clock = SystemClock()
    deadline = clock.now_ns() + round(within_s * 1e9)
    reason = "no answer"
    while clock.now_ns() < deadline and not stop.is_set():
        pending = bus.ask(query, request, ANSWER_S)
        while (outcome := pending.poll()) is None and not stop.wait(0.01):
            pass
        match outcome:
            case Failed(reason) | queries.Refused(reason):
                stop.wait(0.2)
            case Learnt():
                return outcome
    raise CommandFailed(f"could not teach the model: {reason}")
