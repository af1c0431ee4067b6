"""The data set holds every attempt and answer, explains every column, and nobody's name."""

import csv
import json

import pytest

from services.study.events import Attempted, BrokenOff, Noted
from services.study.exceptions import DataSetThere
from services.study.export import export
from services.study.instruments import SHIPPED as SHIPPED_INSTRUMENTS
from services.study.instruments.library import of_protocol
from services.study.journal import Journal
from services.study.protocols import SHIPPED
from services.study.session.conductor import Conductor
from services.study.study import new_study
from services.study.synthetic.rehearsal import Rehearsal
from services.study.synthetic.run import StudyClock, SyntheticRun
from tests.services.study.test_synthetic import in_order


@pytest.fixture
def done(tmp_path, unsynchronised):
    """A study with three participants of whom the second has withdrawn and the first did something twice."""
    study, clock = new_study(tmp_path / "study", SHIPPED["thesis"]), StudyClock()
    instruments = of_protocol(study.protocol, study.folder)
    with Journal(study.raw, clock) as journal:
        conductor = Conductor(study.protocol, journal, instruments)
        SyntheticRun(study.protocol, instruments, conductor, clock, Rehearsal(3), lessons=in_order).go(1)
        conductor.withdraw(2, delete=True)
        conductor.invalid(1, "OnStyl/training", "the alarm rang", repeat=False)
        times = {"acting": 3.5, "holding": 0.0, "alone": 1.0, "other": 2.0}
        conductor.broke_off(BrokenOff(participant=3, part="OnKey/2", why="killed by signal 9", raw=times))
        journal.add(Noted(participant=1, text="Anna was tired"))
        entries = list(journal.entries)
    return study, entries, instruments, tmp_path / "out"


def tables(folder):
    return {
        path.name.split("description-")[1].removesuffix("_data.csv"): list(
            csv.DictReader(path.read_text(encoding="utf-8").splitlines())
        )
        for path in folder.glob("data/*_data.csv")
    }


def test_every_attempt_is_there_and_whoever_withdrew_is_not(done):
    study, entries, instruments, out = done
    export(study, entries, instruments, out)
    found = tables(out)
    attempts = [entry.event for entry in entries if isinstance(entry.event, Attempted)]
    assert len(found["attempts"]) == len(attempts)
    assert {row["participant"] for table in found.values() for row in table} == {"P01", "P03"}
    (broken,) = found["broken_off"]
    assert (broken["participant"], broken["part"], broken["acting"]) == ("P03", "OnKey/2", "3.5")
    void = {
        row["void"] for row in found["attempts"] if row["part"] == "OnStyl/training" and row["participant"] == "P01"
    }
    assert void == {"the alarm rang"}


def test_every_column_is_explained_and_synthetic_rows_are_marked(done):
    study, entries, instruments, out = done
    export(study, entries, instruments, out)
    described = json.loads((out / "dataset_description.json").read_text(encoding="utf-8"))
    explained = {one["name"] for one in described["variableMeasured"] if one["description"]}
    rows = [row for table in tables(out).values() for row in table]
    assert {column for row in rows for column in row} <= explained
    assert {row["synthetic"] for row in rows} == {"True"}
    assert "no person took part" in described["description"]


def test_no_note_of_the_experimenter_is_in_it(done):
    study, entries, instruments, out = done
    export(study, entries, instruments, out)
    assert not [path for path in out.rglob("*") if path.is_file() and b"Anna" in path.read_bytes()]


def test_two_exports_are_the_same_and_none_goes_over_another(done):
    study, entries, instruments, out = done
    export(study, entries, instruments, out)
    export(study, entries, instruments, out.parent / "again")
    files = sorted(path.relative_to(out) for path in out.rglob("*") if path.is_file())
    assert all((out / one).read_bytes() == (out.parent / "again" / one).read_bytes() for one in files)
    with pytest.raises(DataSetThere, match="a data set goes into a new folder"):
        export(study, entries, instruments, out)


def test_every_questionnaire_that_was_asked_is_there_as_it_was(done):
    study, entries, instruments, out = done
    export(study, entries, instruments, out)
    there = {path.stem: path.read_bytes() for path in (out / "materials" / "instruments").iterdir()}
    assert there == {name: SHIPPED_INSTRUMENTS[name].read_bytes() for name in instruments}


def test_every_question_and_every_level_of_an_answer_is_explained(done):
    study, entries, instruments, out = done
    export(study, entries, instruments, out)
    text = (out / "README.md").read_text(encoding="utf-8")
    for question in (one for instrument in instruments.values() for one in instrument.questions):
        assert f"- `{question.name}`: {question.text['en']}" in text
        for option in getattr(question, "options", ()):
            assert f"  - `{option.name}`: {option.text['en']}" in text
    described = json.loads((out / "dataset_description.json").read_text(encoding="utf-8"))
    (age,) = [one for one in described["variableMeasured"] if one["name"] == "age"]
    assert {"@type": "DefinedTerm", "termCode": "from_55", "name": "55–64"} in age["valueReference"]
