"""The real services on one bus in one process, each stepped at its own rate by a clock that runs as fast as it can."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from lfd.motion.demonstration import Demonstration
from protocol import queries
from protocol.messages import Purpose
from protocol.queries import AddDemonstration, Learnt, Reset
from services.bus.arrays import motion_to_wire, vector3
from services.bus.bus import Pending
from services.bus.memory import MemoryBus, MemoryNetwork
from services.master.service import build as build_master
from services.model.learning import MODELS, Fit
from services.model.service import build as build_model
from services.offline.eyes import Eyes
from services.process.clock import ManualClock
from services.process.config import Configuration
from services.process.exceptions import CommandFailed
from services.robot.memory import Volatile
from services.robot.service import build as build_robot
from services.station.frontend import Frontend
from services.station.service import StationService
from services.station.settings import settings

HOLDER = "rehearsal"


def give(stage: Stage, scene: str, demonstrations: Sequence[Demonstration]) -> None:
    """Give the model of a stage what it starts from.

    Args:
        stage: whose model.
        scene: that it is for.
        demonstrations: in the base frame.

    Raises:
        CommandFailed: it does not take it.
    """
    bus = stage.bus()
    for demonstration in demonstrations:
        shown = demonstration.trajectory
        motion = motion_to_wire(shown.positions, shown.orientations, shown.duration, shown.opening)
        condition = tuple(demonstration.condition.tolist())
        request = AddDemonstration(Purpose.INITIAL, motion, vector3(demonstration.origin), scene, condition)
        _learn(stage, bus.ask(queries.ADD_DEMONSTRATION, request))


def _learn(stage: Stage, pending: Pending[Learnt]) -> None:
    stage.run(lambda: pending.poll() is not None)
    outcome = pending.poll()
    if not isinstance(outcome, Learnt):
        raise CommandFailed(f"the model does not learn: {outcome}")


class Stepped(Protocol):
    """What has a rate and a step."""

    @property
    def rate_hz(self) -> float:
        """At which it is stepped."""
        ...

    def step(self, now_ns: int) -> None:
        """One step."""
        ...


@dataclass
class _Turn:
    """Of a service; one that rests keeps its place in time, and is not stepped."""

    service: Stepped
    period_ns: int
    due_ns: int
    rests: bool = False


class Stage:
    """Robot, model, master and eyes, and one station after another.

    Args:
        configuration: of all services; master and station are to be scripted ones.
        models: for the model service to choose from.
    """

    def __init__(self, configuration: Configuration, models: Mapping[str, Fit] = MODELS) -> None:
        self.clock = ManualClock()
        self._network = MemoryNetwork(self.clock)
        self._configuration = configuration
        robot = build_robot(self.bus(), self.clock, configuration, Volatile())
        self._model = build_model(self.bus(), self.clock, configuration, models)
        self._master = build_master(self.bus(), self.clock, configuration)
        eyes = Eyes(self.bus(), np.random.default_rng(configuration.seed))
        self._masters = self._turn(self._master)
        self._turns = [*(self._turn(service) for service in (robot, eyes, self._model)), self._masters]

    def bus(self) -> MemoryBus:
        """A way in, for a service or for whoever looks on."""
        return self._network.bus()

    def run(self, until: Callable[[], bool]) -> None:
        """Let time pass until something is the case."""
        while not until():
            now = min(turn.due_ns for turn in self._turns)
            self.clock.advance((now - self.clock.now_ns()) / 1e9)
            for turn in self._turns:
                if turn.due_ns <= now:
                    turn.due_ns += turn.period_ns
                    if not turn.rests:
                        turn.service.step(now)

    def teach(self, arrangement: Reset | None, refinements_allowed: int, until: Callable[[], bool]) -> None:
        """Let a station run Algorithm 1 under one arrangement.

        Args:
            arrangement: what every reset asks for; None leaves that to the station.
            refinements_allowed: attempts at one update; with 0 a failure is only seen.
            until: says that the station has finished.
        """
        # Where nothing is taught nobody corrects, and the robot listens to no master.
        self._masters.rests = refinements_allowed == 0
        self._station(None, until, arrangement=arrangement, refinements_allowed=refinements_allowed)

    def sit(self, frontend: Frontend, arrangement: Reset, until: Callable[[], bool]) -> None:
        """Let somebody sit at a station; see `teach`."""
        self._masters.rests = False
        self._station(frontend, until, arrangement=arrangement)

    def close(self) -> None:
        """Let go of the device and of the database."""
        self._master.close()
        self._model.close()

    def _station(self, frontend: Frontend | None, until: Callable[[], bool], **chosen: Any) -> None:
        configured = settings(self._configuration.station, self._configuration.operator)
        bus = self.bus()
        chosen_settings = replace(configured, holder=HOLDER, **chosen)
        station = self._turn(StationService(bus, chosen_settings, frontend, self._configuration.seed))
        self._turns.append(station)
        try:
            self.run(until)
        finally:
            self._turns.remove(station)
            bus.close()

    def _turn(self, service: Stepped) -> _Turn:
        return _Turn(service, round(1e9 / service.rate_hz), self.clock.now_ns())
