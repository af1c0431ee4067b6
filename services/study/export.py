"""A study's data for others: pseudonymous, as Psych-DS has them (https://psych-ds.github.io), with a codebook.

    dataset_description.json   what it is, and every variable (schema.org)
    data/*_data.csv            tidy tables; made from the journal, never changed
    materials/                 protocol, preregistration, every questionnaire that was asked
    README.md                  the codebook, for people

No name, no contact and no note of the experimenter is in it: those are not data of the participants.
"""

from __future__ import annotations

import csv
import io
import shutil
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec

from services.process.exceptions import CannotWrite
from services.process.files import make_folder, write_whole
from services.study import codebook, preregistration
from services.study.events import Attempted, Entry
from services.study.exceptions import DataSetThere
from services.study.instruments import library
from services.study.instruments.instrument import Instrument
from services.study.protocol import protocol as protocol_file
from services.study.records import code, observed
from services.study.session.course import Participant, participants
from services.study.study import Study

SYNTHETIC = "no person took part: simulated"

Row = Sequence[object]


@dataclass(frozen=True)
class _Table:
    """A file of data."""

    name: str
    columns: Sequence[str]
    rows: Sequence[Row]

    @property
    def text(self) -> str:
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows(self.rows)
        return out.getvalue()


def export(study: Study, entries: Sequence[Entry], instruments: Mapping[str, Instrument], folder: Path) -> list[Path]:
    """Write the data set.

    Args:
        study: its folder.
        entries: of its journal.
        instruments: that its protocol names.
        folder: a new one.

    Returns:
        The tables.

    Raises:
        DataSetThere: the folder holds something.
        CannotWrite: it cannot be written.
    """
    tables = list(_tables(study, entries, instruments))
    try:
        if folder.exists() and any(folder.iterdir()):
            raise DataSetThere(folder)
        for part in (folder, folder / "data", folder / "materials", folder / "materials" / library.FOLDER):
            make_folder(part)
        written = [_written(folder / "data", study.protocol.name, table) for table in tables]
        description = msgspec.json.format(msgspec.json.encode(_description(study, entries, instruments, tables)))
        write_whole(folder / "dataset_description.json", description + b"\n")
        write_whole(folder / "README.md", _readme(study, entries, instruments, tables).encode())
        _materials(study, instruments, folder / "materials")
    except OSError as error:
        raise CannotWrite(folder, error.strerror or str(error)) from None
    return written


def _written(folder: Path, study: str, table: _Table) -> Path:
    path = folder / f"study-{study.replace('_', '')}_description-{table.name}_data.csv"
    write_whole(path, table.text.encode())
    return path


def _materials(study: Study, instruments: Iterable[str], folder: Path) -> None:
    for name in (protocol_file.FILE, preregistration.FILE):
        if (study.folder / name).exists():
            shutil.copyfile(study.folder / name, folder / name)
    own = sorted((study.folder / library.FOLDER).glob("*.toml"))
    # Those that come with Retouch as well: another version of it may ask otherwise.
    asked = [library.file(study.folder, name) for name in instruments]
    for path in dict.fromkeys((*own, *asked)):
        shutil.copyfile(path, folder / library.FOLDER / path.name)


def _tables(study: Study, entries: Sequence[Entry], instruments: Mapping[str, Instrument]) -> Iterator[_Table]:
    observations = observed(study.protocol, entries, instruments, study.protocol.name)
    people = [one for one in participants(entries).values() if one.gone != "withdrawn"]
    for name, structs in (
        ("participants", observations.backgrounds),
        ("outcomes", observations.outcomes),
        ("ratings", observations.ratings),
    ):
        columns = structs[0].__struct_fields__ if structs else ("participant",)
        rows = [[*(getattr(one, column) for column in columns), observations.synthetic] for one in structs]
        yield _Table(name, (*columns, "synthetic"), rows)
    yield _Table("attempts", _ATTEMPT, [row for one in people for row in _attempts(one)])
    yield _Table("broken_off", _BROKEN_OFF, [row for one in people for row in _broken_off(one)])
    yield _Table("answers", _ANSWER, [row for one in people for row in _answers(one)])


_ATTEMPT = (
    *("participant", "part", "number", "teaching", "updates", "success", "reached", "kicked_over", "collision"),
    *("active", "began", "ended", "void", "recording", "synthetic"),
)
_TIMES = ("acting", "holding", "alone", "other")
_BROKEN_OFF = ("participant", "part", "why", *_TIMES, "synthetic")
_ANSWER = ("participant", "instrument", "after", "question", "place", "answer", "synthetic")


def _attempts(one: Participant) -> Iterator[Row]:
    """All of them, those too that do not count."""
    kept = [(attempt, one.invalid.get(name, "")) for name, attempts in one.attempts.items() for attempt in attempts]
    for attempt, void in (*kept, *one.void):
        yield (code(one.number), *_of(attempt), void, attempt.recording, one.enrolled.synthetic)


def _broken_off(one: Participant) -> Iterator[Row]:
    """What came to no end, with its times."""
    for event in one.broken_off:
        times = (event.raw.get(name, 0.0) for name in _TIMES)
        yield (code(one.number), event.part, event.why, *times, one.enrolled.synthetic)


def _of(attempt: Attempted) -> Iterable[object]:
    teaching = attempt.teaching.value if attempt.teaching is not None else ""
    yield from (attempt.part, attempt.number, teaching, attempt.updates, attempt.success, attempt.reached)
    yield from (attempt.kicked_over, attempt.collision, attempt.active, attempt.began, attempt.ended)


def _answers(one: Participant) -> Iterator[Row]:
    for answered in one.answers.values():
        for name, answer in answered.answers.items():
            place = answered.shown.index(name) + 1 if name in answered.shown else ""
            yield (
                *(code(one.number), answered.instrument, answered.after, name, place, answer),
                one.enrolled.synthetic,
            )


def _description(
    study: Study, entries: Sequence[Entry], instruments: Mapping[str, Instrument], tables: Sequence[_Table]
) -> dict[str, object]:
    columns = dict.fromkeys(column for table in tables for column in table.columns)
    return {
        "@context": "https://schema.org/",
        "@type": "Dataset",
        "name": study.protocol.title,
        "description": _about(study, entries),
        "version": study.protocol.version,
        "schemaVersion": "Psych-DS 1.0.0",
        "temporalCoverage": f"{entries[0].at[:10]}/{entries[-1].at[:10]}" if entries else "",
        "variableMeasured": codebook.variables(list(columns), instruments),
    }


def _about(study: Study, entries: Sequence[Entry]) -> str:
    people = [one for one in participants(entries).values() if one.gone != "withdrawn"]
    synthetic = any(one.enrolled.synthetic for one in people)
    methods = ", ".join(method.name for method in study.protocol.methods)
    return f"{len(people)} participants{f' ({SYNTHETIC})' if synthetic else ''} adapted models by {methods}."


def _readme(
    study: Study, entries: Sequence[Entry], instruments: Mapping[str, Instrument], tables: Sequence[_Table]
) -> str:
    lines = [f"# {study.protocol.title}", "", _about(study, entries), "", "## Codebook", ""]
    for table in tables:
        lines += [f"### {table.name}, {len(table.rows)} rows", "", *codebook.columns(table.columns, instruments), ""]
    for instrument in instruments.values():
        lines += [*codebook.questions(instrument), ""]
    return "\n".join(lines)
