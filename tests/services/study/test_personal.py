"""Who somebody is lies apart, for its owner's eyes alone, and goes with what was recorded of them."""

import csv

import pytest

from services.process.exceptions import CannotWrite
from services.study.personal import Personal, recordings_of


@pytest.fixture
def personal(tmp_path):
    return Personal(tmp_path)


def test_names_are_in_a_file_that_only_its_owner_reads(personal, tmp_path):
    personal.name(2, "Bea, the second")
    personal.name(1, "Ada")
    path = tmp_path / "identities" / "names.csv"
    assert path.stat().st_mode & 0o777 == 0o600
    with path.open(encoding="utf-8", newline="") as file:
        assert list(csv.reader(file)) == [["participant", "name"], ["1", "Ada"], ["2", "Bea, the second"]]


def test_deletion_takes_name_and_recordings_of_one_alone(personal, tmp_path):
    for number in (1, 2):
        personal.name(number, f"somebody {number}")
        (recordings_of(tmp_path, number) / "part").mkdir(parents=True)
    personal.delete(1)
    personal.delete(1)
    assert personal.names() == {2: "somebody 2"}
    assert not recordings_of(tmp_path, 1).exists()
    assert recordings_of(tmp_path, 2).exists()


def test_of_whom_nothing_is_kept_nothing_is_written(personal, tmp_path):
    personal.delete(1)
    assert not (tmp_path / "identities").exists()


def test_a_file_that_holds_something_else_is_not_overwritten(personal, tmp_path):
    (tmp_path / "identities").mkdir()
    path = tmp_path / "identities" / "names.csv"
    path.write_text("something else\nentirely\n")
    with pytest.raises(CannotWrite, match=r"names.csv"):
        personal.name(1, "Ada")
    assert path.read_text() == "something else\nentirely\n"


def test_the_consoles_key_stays_the_same(personal, tmp_path):
    assert personal.key() == Personal(tmp_path).key()
    assert len(personal.key()) >= 12
