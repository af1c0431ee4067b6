"""Observations from anybody's table: a CSV with a line a participant, method and model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

from lfd.exceptions import TableError
from lfd.store.spreadsheet import Table, read_table
from services.process.suggestion import nearest, right
from services.study.analysis.cells import Cells
from services.study.analysis.exceptions import BadRenaming
from services.study.analysis.observations import Background, Observations, Outcome, Rating, Training

NEEDED = ("participant", "method", "model", "seconds")

OPTIONAL = (
    *("adapted", "position", "refinements", "updates", "valid", "reason"),
    *("workload", "raw_tlx", "sus", "trust"),
    *("training_passed", "training_seconds"),
    *("gender", "age", "field", "gaming", "teleoperation", "handedness", "group"),
    "synthetic",
)

_BACKGROUND = ("gender", "age", "field", "gaming", "teleoperation", "handedness", "group")
_PERCENT = 100.0
LARGEST_BYTES = 1 << 24

Value = TypeVar("Value")


def read_observations(
    path: Path, columns: Mapping[str, str] | None = None, methods: Mapping[str, str] | None = None
) -> Observations:
    """Read a table whose first line names its columns: `NEEDED`, and any of `OPTIONAL`.

    Separators, decimal marks, byte order marks and quotes are found out, see `read_table`. What is said of a
    participant, or of a participant and a method, may stand in each of the lines or in one of them. An empty cell was
    not measured. Without a column "adapted" a model with a time was adapted.

    Args:
        path: of the file.
        columns: the file's names of columns, by ours.
        methods: the file's names of methods, by ours.

    Raises:
        TableError: something in it cannot be meant; says where, and what would be right.
        BadRenaming: it has no such column or method.
    """
    names = _names(columns or {})
    table = read_table(path, {theirs.casefold(): "" for theirs in names.values()}, tuple(names.values()), LARGEST_BYTES)
    theirs = {ours: name for ours, name in names.items() if name in table.columns}
    _check_columns(path, table, theirs, columns or {})
    if not table.rows:
        raise TableError(path, "there is no line below the first: nobody was observed")
    reading = _Reading(path, {theirs: ours for ours, theirs in (methods or {}).items()})
    for row in table.rows:
        reading.take(Cells(row, theirs))
    for ours, name in (methods or {}).items():
        if name not in reading.seen_methods:
            raise BadRenaming(f"--methods {ours}={name}", f"no line has it: {right(name, reading.seen_methods)}")
    return reading.observations(f"{path.name}", table.others, "adapted" in theirs)


def _names(columns: Mapping[str, str]) -> dict[str, str]:
    """The file's names of all columns, by ours."""
    for ours in columns:
        if ours not in (*NEEDED, *OPTIONAL):
            raise BadRenaming(f"--columns {ours}=...", f"no column is called so: {right(ours, (*NEEDED, *OPTIONAL))}")
    names = {ours: columns.get(ours, ours).casefold() for ours in (*NEEDED, *OPTIONAL)}
    # A name that is given to one column is no longer another's: what was theirs by chance is not asked for.
    given = {name.casefold() for name in columns.values()}
    names = {ours: name for ours, name in names.items() if ours in columns or name not in given}
    twice = [name for name in names.values() if list(names.values()).count(name) > 1]
    if twice:
        raise BadRenaming("--columns", f"{twice[0]!r} is given to two columns")
    return names


def _check_columns(path: Path, table: Table, theirs: Mapping[str, str], columns: Mapping[str, str]) -> None:
    for ours, name in columns.items():
        if ours not in theirs:
            there = (*table.columns, *table.others)
            raise BadRenaming(f"--columns {ours}={name}", f"{path} has no such column: {right(name.casefold(), there)}")
    for needed in NEEDED:
        if needed not in theirs:
            near = nearest(needed, table.others) or f"its first line names {', '.join((*table.columns, *table.others))}"
            raise TableError(path, f"no column {needed}: {near}; give it another's name by --columns {needed}=THEIRS")


@dataclass
class _Reading:
    """What the lines up to here have said."""

    path: Path
    renamed: Mapping[str, str]
    seen_methods: list[str] = field(default_factory=list)
    outcomes: dict[tuple[str, str, int], tuple[int, Outcome]] = field(default_factory=dict)
    said: dict[tuple[str, ...], tuple[int, object]] = field(default_factory=dict)

    def take(self, cells: Cells) -> None:
        """Take a line.

        Raises:
            TableError: it cannot be meant, or contradicts another one.
        """
        participant, theirs = cells.name("participant"), cells.name("method")
        method = self.renamed.get(theirs, theirs)
        if theirs not in self.seen_methods:
            self.seen_methods.append(theirs)
        model = cells.whole("model", 1)
        if model is None:
            raise cells.wrong("model", "it is empty: every line needs the number of its model")
        seconds, adapted = cells.number("seconds", 0.0, above=True), cells.flag("adapted")
        before = self.outcomes.get((participant, method, model))
        if before is not None:
            reason = f"participant {participant}, method {method}, model {model} are in line {before[0]} already"
            raise cells.wrong("model", f"{reason}: a line each")
        valid = cells.flag("valid")
        outcome = Outcome(
            participant=participant,
            method=method,
            model=model,
            position=self._position(cells, participant, method),
            adapted=seconds is not None if adapted is None else adapted,
            seconds=seconds,
            refinements=cells.whole("refinements", 0),
            updates=cells.whole("updates", 0),
            valid=valid is None or valid,
            reason=cells.text("reason"),
        )
        self.outcomes[participant, method, model] = (cells.row.line, outcome)
        for column in ("workload", "raw_tlx", "sus"):
            self._say(cells, cells.number(column, 0.0, _PERCENT), column, participant, method)
        self._say(cells, cells.number("trust"), "trust", participant, method)
        self._say(cells, cells.flag("training_passed"), "training_passed", participant, method)
        self._say(cells, cells.number("training_seconds", 0.0), "training_seconds", participant, method)
        for column in _BACKGROUND:
            self._say(cells, cells.text(column) or None, column, participant)
        self._say(cells, cells.flag("synthetic"), "synthetic")

    def _position(self, cells: Cells, participant: str, method: str) -> int | None:
        position = cells.whole("position", 1)
        if position is not None:
            self._say(cells, position, "position", participant, method)
            line, other = self.said.setdefault(("at", participant, str(position)), (cells.row.line, method))
            if other != method:
                raise cells.wrong("position", f"{position} is that of method {other} in line {line}: one method each")
        return position

    def _say(self, cells: Cells, value: object, column: str, *of: str) -> None:
        """Remember what holds for more lines than one.

        Raises:
            TableError: another line says something else.
        """
        if value is None:
            return
        line, before = self.said.setdefault((column, *of), (cells.row.line, value))
        if before != value:
            whose = ("the study", "a participant", "a participant and method")[len(of)]
            reason = f"{_shown(value)} contradicts {_shown(before)} in line {line}: {whose} can have only one"
            raise cells.wrong(column, reason)

    def _get(self, type_: type[Value], column: str, *of: str) -> Value | None:
        value = self.said.get((column, *of), (0, None))[1]
        return value if isinstance(value, type_) else None

    def observations(self, source: str, unknown: tuple[str, ...], has_adapted: bool) -> Observations:
        """All of it."""
        outcomes = tuple(outcome for _, outcome in self.outcomes.values())
        pairs = dict.fromkeys((one.participant, one.method) for one in outcomes)
        people = dict.fromkeys(one.participant for one in outcomes)
        notes = [f"columns that are not known and were not read: {', '.join(unknown)}"] if unknown else []
        notes += [] if has_adapted else ["no column adapted: a model with a time counts as adapted"]
        return Observations(
            outcomes=outcomes,
            ratings=tuple(rating for pair in pairs if (rating := self._rating(*pair))),
            backgrounds=tuple(self._background(one) for one in people),
            trainings=tuple(training for pair in pairs if (training := self._training(*pair))),
            synthetic=bool(self._get(bool, "synthetic")),
            source=source,
            notes=tuple(notes),
        )

    def _rating(self, participant: str, method: str) -> Rating | None:
        values = {name: self._get(float, name, participant, method) for name in ("workload", "raw_tlx", "sus", "trust")}
        if all(value is None for value in values.values()):
            return None
        return Rating(participant=participant, method=method, **values)

    def _training(self, participant: str, method: str) -> Training | None:
        passed = self._get(bool, "training_passed", participant, method)
        seconds = self._get(float, "training_seconds", participant, method)
        if passed is None and seconds is None:
            return None
        return Training(participant=participant, method=method, passed=passed is not False, seconds=seconds)

    def _background(self, participant: str) -> Background:
        said = {name: self._get(str, name, participant) or "" for name in _BACKGROUND}
        return Background(participant=participant, **said)


def _shown(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)
