"""What happened in a teaching run, for people and for programs."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import msgspec

from protocol.messages import Attempt, Mode, Vector3
from services.commands.up.tally import Tally
from services.process.exceptions import CannotWrite
from services.process.files import write_whole


class VerdictReport(msgspec.Struct, frozen=True):
    """The three criteria."""

    reached: bool
    kicked_over: bool
    collision: bool


class AttemptReport(msgspec.Struct, frozen=True):
    """One episode."""

    scene: str
    variant: str
    object_position: Vector3
    model_version: int
    mode: str
    operator_input: bool
    verdict: VerdictReport
    duration_s: float
    condition: tuple[float, ...]


class Report(msgspec.Struct, frozen=True):
    """One run of `retouch up`.

    Attributes:
        loop_closed: a prediction failed, was refined, learnt, and a later one succeeded by itself.
        reason: why not; empty where it did.
        processes: name to process id, as they ran last.
        restarts: of each process.
        recording: the .rrd file; later parts lie beside it, numbered from -2 on.
        recording_fault: why it broke off last; empty where it never did.
        attempts: every episode in order.
        first_motion_s: from the command to the robot's first motion; negative where it never moved.
        executions: what came of those of a skill; None where it was taught.
    """

    loop_closed: bool
    reason: str
    processes: dict[str, int]
    restarts: dict[str, int]
    recording: str
    recording_fault: str
    attempts: list[AttemptReport]
    first_motion_s: float
    executions: Tally | None = None


def attempt_reports(attempts: Iterable[Attempt]) -> list[AttemptReport]:
    """The attempts of a run, as they go into the report."""
    return [
        AttemptReport(
            scene=a.scene,
            variant=a.variant,
            object_position=a.object_position,
            model_version=a.model_version,
            mode=a.mode.value,
            operator_input=a.operator_input,
            verdict=VerdictReport(a.verdict.reached, a.verdict.kicked_over, a.verdict.collision),
            duration_s=a.duration_s,
            condition=a.condition,
        )
        for a in attempts
    ]


def write(report: Report, path: Path) -> None:
    """Write the report as JSON, whole or not at all.

    Raises:
        CannotWrite: the disk is full, or its folder is gone or read-only.
    """
    try:
        write_whole(path, msgspec.json.format(msgspec.json.encode(report)) + b"\n")
    except OSError as error:
        raise CannotWrite(path, error.strerror or str(error)) from None


def attempt_line(number: int, attempt: Attempt) -> str:
    """An episode in one line."""
    faults = faults_of(attempt)
    who = "refinement" if attempt.mode is Mode.REFINE else "prediction"
    target, values = ("condition", attempt.condition) if attempt.condition else ("object at", attempt.object_position)
    what = faults or "reached"
    place = f"{attempt.scene} {attempt.variant}".strip()
    return (
        f"{number}. {who} of model version {attempt.model_version} in {place},"
        f" {target} ({', '.join(f'{value:.3f}' for value in values)}) m: {what}, {attempt.duration_s:.1f} s"
    )


def faults_of(attempt: Attempt) -> str:
    """What went wrong in an episode, in a few words; empty where nothing did."""
    verdict = attempt.verdict
    faults = (
        ("collision", verdict.collision),
        ("kicked over", verdict.kicked_over),
        ("not reached", not verdict.reached),
    )
    return ", ".join(word for word, happened in faults if happened)
