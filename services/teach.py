"""`retouch teach`: the first demonstrations, taught offline by the scripted operator in the simulator."""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator
from typing import TypeVar

import msgspec
import numpy as np
from numpy.typing import NDArray

from lfd.resampling import from_samples
from lfd.trajectory import Trajectory
from protocol import queries
from protocol.queries import AddDemonstration, Kind, Learnt, Query
from services.arrays import motion_to_wire, vector3
from services.bus import Failed
from services.clock import SystemClock
from services.config import Configuration
from services.exceptions import CommandFailed
from services.robot.arm import Arm
from services.robot.rollout import rollout, simulated_arm
from services.runner import stop_on_signals
from services.zenoh_bus import ZenohBus, connect
from sim.description import prepare
from sim.scenes import scene as find_scene
from sim.scenes.scene import Scene
from sim.steering import steer

log = logging.getLogger(__name__)

Array = NDArray[np.float64]
Req = TypeVar("Req", bound=msgspec.Struct)

DURATION_S = 10.0
"""Of a demonstration: the thesis' time of an autonomous execution."""

TRIES = 5
ANSWER_S = 10.0
MODEL_WITHIN_S = 60.0


def teach(configuration: Configuration) -> None:
    """Give the model its first demonstrations, where it has none.

    Raises:
        ServiceError: there is no model to teach, or no motion could be taught.
    """
    stop = stop_on_signals()
    bus = connect(configuration.connect, configuration.name, "teach", SystemClock())
    try:
        scene = find_scene(configuration.robot.scene)
        state = _answered(bus, queries.DESCRIBE, queries.Describe(), stop, MODEL_WITHIN_S).state
        if state.updates or state.demonstrations >= len(scene.training_positions):
            log.info("the model has %d demonstrations and %d updates", state.demonstrations, state.updates)
            return
        # All are taught before the first is given, so that nobody predicts from half of them; what an earlier run
        # that was killed has given already is not given again.
        taught = list(demonstrations(scene, configuration.seed, stop))
        for position, trajectory in taught[state.demonstrations :]:
            motion = motion_to_wire(trajectory.positions, trajectory.orientations, trajectory.duration)
            request = AddDemonstration(Kind.INITIAL, motion, vector3(position), scene.name)
            _answered(bus, queries.ADD_DEMONSTRATION, request, stop)
        log.info("taught %d demonstrations of %s", len(taught), scene.name)
    finally:
        bus.close()


def demonstrations(scene: Scene, seed: int, stop: threading.Event) -> Iterator[tuple[Array, Trajectory]]:
    """Object positions, and motions that reached them, as the arm did them.

    Args:
        scene: taught in its first variant.
        seed: of the hand's unsteadiness.
        stop: ends it early.

    Raises:
        CommandFailed: no try at a position succeeded.
    """
    rng = np.random.default_rng(seed)
    arm = simulated_arm(scene, scene.variants[0], prepare())
    for position in scene.training_positions:
        if stop.is_set():
            return
        yield position, demonstrate(arm, scene, position, rng)


def demonstrate(arm: Arm, scene: Scene, position: Array, rng: np.random.Generator) -> Trajectory:
    """Steer the arm to an object, again where that fails; the motion measured.

    Raises:
        CommandFailed: no try succeeded.
    """
    for _ in range(TRIES):
        way = steer(scene.corridor(scene.variants[0], position), rng)
        times = np.linspace(0.0, DURATION_S, len(way.positions))
        outcome = rollout(
            arm, from_samples(times, way.positions, way.orientations, 75), position, variant=scene.variants[0]
        )
        if outcome.verdict.success:
            return outcome.measured
    raise CommandFailed(f"no motion to an object at {np.round(position, 3).tolist()} succeeded in {TRIES} tries")


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
    raise CommandFailed(f"could not {query.about}: {reason}")
