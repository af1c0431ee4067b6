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
        nice: how far it stands back from the processor, so that drawing does not disturb control; where it is negative,
            it goes before others as far as the system lets it.
    """

    name: str
    module: str
    about: str
    nice: int = 0


PROCESSES: tuple[Process, ...] = (
    Process(
        "robot",
        "services.robot.service",
        "the process that owns the arm: executes, corrects, judges, keeps safe",
        nice=-10,
    ),
    Process("camera", "services.camera.service", "the process that draws the head and wrist pictures", nice=5),
    Process("perception", "services.perception.service", "the process that finds the object in the pictures", nice=5),
    Process("model", "services.model.service", "the process that owns the learnt model and its database"),
    Process("master", "services.master.service", "the process that owns the operator's input device", nice=-10),
    Process("viewer", "services.viewer.service", "the process that shows and records with Rerun", nice=5),
    Process("station", "services.station.service", "the process that serves the operator's page and runs the teaching"),
)

PROCESS_NAMES = tuple(process.name for process in PROCESSES)


def process(name: str) -> Process:
    """The process of this name.

    Raises:
        KeyError: there is none.
    """
    return {p.name: p for p in PROCESSES}[name]
