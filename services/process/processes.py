"""The processes, as data."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Process:
    """One role of the system.

    Attributes:
        name: of the command that starts it, and the last chunk of the keys that it publishes on.
        module: whose `build(bus, clock, configuration)` makes the service.
        about: one line for `--help`.
        nice: how far it stands back from the processor; drawing must not disturb control.
    """

    name: str
    module: str
    about: str
    nice: int = 0


PROCESSES: tuple[Process, ...] = (
    Process("robot", "services.robot.service", "own the arm: execute, correct, judge, keep safe"),
    Process("camera", "services.camera.service", "draw the head and wrist pictures", nice=5),
    Process("perception", "services.perception.service", "find the object in the pictures", nice=5),
    Process("model", "services.model.service", "own the learnt model and its database"),
    Process("master", "services.master.service", "own the operator's input device"),
    Process("viewer", "services.viewer.service", "show and record with Rerun", nice=5),
    Process("station", "services.station.service", "serve the operator's page, run the teaching workflow"),
)

PROCESS_NAMES = tuple(process.name for process in PROCESSES)


def process(name: str) -> Process:
    """The process of this name.

    Raises:
        KeyError: there is none.
    """
    return {p.name: p for p in PROCESSES}[name]
