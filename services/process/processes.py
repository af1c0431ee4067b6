"""The processes, as data."""

from __future__ import annotations

from dataclasses import dataclass

NOBODY_IN_PARTICULAR = "operator"
"""The operator's name where nobody gave one."""


@dataclass(frozen=True)
class Process:
    """One role of the system.

    Attributes:
        name: of the command that starts it, and the last chunk of the keys that it publishes on.
        module: whose `build(bus, clock, configuration)` makes the service.
        about: one line for `--help`.
        nice: how far it stands back from the processor, so that drawing does not disturb control; where it is negative,
            it goes before others as far as the system lets it.
        at_operator: there is one for each operator.
    """

    name: str
    module: str
    about: str
    nice: int = 0
    at_operator: bool = False

    def named(self, operator: str) -> str:
        """Its name on the network: that of an operator's process says whose it is, so that two can be there at once."""
        # Imported here: whoever only asks for help does not wait for the protocol.
        from protocol.names import process_name  # noqa: PLC0415

        named = self.at_operator and operator != NOBODY_IN_PARTICULAR
        return process_name(self.name, operator) if named else self.name


PROCESSES: tuple[Process, ...] = (
    Process(
        "robot",
        "services.robot.service",
        "the process that owns the arm: executes, corrects, judges, keeps safe",
        nice=-10,
    ),
    Process("camera", "services.camera.service", "the process that publishes what the cameras see", nice=5),
    Process("perception", "services.perception.service", "the process that finds the object in the pictures", nice=5),
    Process("model", "services.model.service", "the process that owns the learnt model and its database"),
    Process(
        "master",
        "services.master.service",
        "the process that owns the operator's input device",
        nice=-10,
        at_operator=True,
    ),
    Process(
        "viewer", "services.viewer.service", "the process that shows and records with Rerun", nice=5, at_operator=True
    ),
    Process(
        "station",
        "services.station.service",
        "the process that serves the operator's page and runs the teaching",
        at_operator=True,
    ),
)

PROCESS_NAMES = tuple(process.name for process in PROCESSES)


def process(name: str) -> Process:
    """The process of this name.

    Raises:
        KeyError: there is none.
    """
    return {p.name: p for p in PROCESSES}[name]
