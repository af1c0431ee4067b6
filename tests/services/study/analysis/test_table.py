"""Tables from anywhere: whatever wrote them, and one line for what cannot be meant."""

import pytest

from lfd.exceptions import TableError
from services.study.analysis.exceptions import BadRenaming
from services.study.analysis.table import read_observations

HEAD = "participant,method,model,adapted,seconds,refinements,updates,workload"


@pytest.fixture
def table(tmp_path):
    def write(*lines, encoding="utf-8"):
        path = tmp_path / "outcomes.csv"
        path.write_bytes("\n".join(lines).encode(encoding))
        return path

    return write


def test_a_line_is_an_outcome_and_what_holds_for_more_lines_is_told_once(table):
    found = read_observations(table(HEAD, "1,OnStyl,1,yes,80.5,3,2,40", "1,OnStyl,2,no,,10,8,40"))
    first, second = found.outcomes
    assert (first.participant, first.method, first.model, first.seconds) == ("1", "OnStyl", 1, 80.5)
    assert (second.adapted, second.seconds, second.refinements, second.updates) == (False, None, 10, 8)
    assert [(one.participant, one.method, one.workload) for one in found.ratings] == [("1", "OnStyl", 40.0)]


@pytest.mark.parametrize(
    ("lines", "encoding"),
    [
        ((HEAD.replace(",", ";"), "1;OnStyl;1;ja;80,5;3;2;40,0"), "utf-8-sig"),
        ((HEAD.replace(",", "\t"), "1\tOnStyl\t1\tTRUE\t80,5\t3.0\t2\t40"), "utf-8"),
        (("sep=;", HEAD.replace(",", ";"), "1;OnStyl;1;1;80.5;3;2;40"), "utf-16"),
        ((HEAD.upper().replace("SECONDS", "Seconds [s]"), '"1","OnStyl",1.0,"yes",80.5,3,2,40', ""), "utf-8"),
    ],
)
def test_whatever_spreadsheets_write_is_the_same_table(table, lines, encoding):
    (one,) = read_observations(table(*lines, encoding=encoding)).outcomes
    assert (one.adapted, one.seconds, one.refinements, one.model) == (True, 80.5, 3, 1)


def test_what_may_be_missing_may(table):
    found = read_observations(table("participant,method,model,seconds", "a,m,1,30", "a,m,2,NaN", "a,m,3,"))
    assert [one.adapted for one in found.outcomes] == [True, False, False]
    assert not found.ratings
    assert not found.trainings
    assert "a model with a time counts as adapted" in found.notes[0]


def test_a_background_may_stand_in_one_of_a_participant_s_lines(table):
    head = "participant,method,model,seconds,age,group,position,training_passed,training_seconds,synthetic"
    found = read_observations(table(head, "a,m,1,30,,,,,,yes", "a,m,2,31,25,group 1,2,no,1800,"))
    assert (found.backgrounds[0].age, found.backgrounds[0].group) == ("25", "group 1")
    assert [(one.passed, one.seconds) for one in found.trainings] == [(False, 1800.0)]
    assert found.synthetic


def test_columns_that_are_not_known_are_named_and_ignored(table):
    found = read_observations(table(",".join(("", HEAD, "mood")), "0,1,OnStyl,1,yes,80.5,3,2,40,fine"))
    assert found.notes == ("columns that are not known and were not read: mood",)


def test_columns_and_methods_that_others_call_otherwise(table):
    path = table("Subject,method,model,Time (s),workload", "7,pen online,1,30,40")
    found = read_observations(path, {"participant": "subject", "seconds": "time"}, {"OnStyl": "pen online"})
    assert (found.outcomes[0].participant, found.outcomes[0].method) == ("7", "OnStyl")
    assert found.ratings[0].method == "OnStyl"


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("1,OnStyl,1,perhaps,80,3,2,40", "column adapted: 'perhaps' is neither yes nor no: write yes"),
        ("1,OnStyl,1,yes,-3,3,2,40", "column seconds: -3 is out of range: it has to be above 0"),
        ("1,OnStyl,1,yes,80 s,3,2,40", "column seconds: '80 s' is not a number: write the number alone"),
        ("1,OnStyl,1,yes,80,3,2,140", "column workload: 140 is out of range: it has to be from 0 to 100"),
        ("1,OnStyl,one,yes,80,3,2,40", "column model: 'one' is not a number"),
        ("1,OnStyl,0,yes,80,3,2,40", "column model: 0 is out of range: it has to be at least 1"),
        ("1,OnStyl,,yes,80,3,2,40", "column model: it is empty"),
        ("1,OnStyl,1,yes,80,2.5,2,40", "column refinements: 2.5 is no whole number"),
        (",OnStyl,1,yes,80,3,2,40", "column participant: it is empty: every line needs a participant"),
        ("1,OnStyl,1,yes,80,3,2,40,5", "9 cell(s) under 8 columns"),
        ("9,OnStyl,1,yes,80,3,2,40", "participant 9, method OnStyl, model 1 are in line 2 already: a line each"),
        ("9,OnStyl,2,yes,80,3,2,41", "column workload: 41 contradicts 40 in line 2: a participant and method can have"),
    ],
)
def test_what_cannot_be_meant_is_named_by_line_and_column(table, line, said):
    with pytest.raises(TableError) as error:
        read_observations(table(HEAD, "9,OnStyl,1,yes,80,3,2,40", line))
    assert f"outcomes.csv: line 3{', ' if said.startswith('column') else ''}" in str(error.value)
    assert said in str(error.value)
    assert "\n" not in str(error.value)


def test_a_position_has_one_method(table):
    path = table("participant,method,model,seconds,position", "1,a,1,30,1", "1,b,1,30,1")
    with pytest.raises(TableError, match="line 3, column position: 1 is that of method a in line 2"):
        read_observations(path)


def test_people_and_synthetic_participants_are_no_one_study(table):
    path = table("participant,method,model,seconds,synthetic", "1,a,1,30,yes", "2,a,1,30,no")
    with pytest.raises(TableError, match="column synthetic: False contradicts True in line 2: the study can have only"):
        read_observations(path)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ((), "the file is empty"),
        ((HEAD,), "nobody was observed"),
        (("participants,method,model,seconds", "1,a,1,3"), "no column participant: did you mean participants?"),
    ],
)
def test_a_table_without_what_is_needed_says_what_that_is(table, lines, said):
    with pytest.raises(TableError) as error:
        read_observations(table(*lines))
    assert said in str(error.value)


@pytest.mark.parametrize(
    ("columns", "methods", "said"),
    [
        ({"participants": "x"}, {}, "--columns participants=...: no column is called so: did you mean participant?"),
        ({"seconds": "tyme"}, {}, "has no such column"),
        ({"seconds": "model", "model": "model"}, {}, "'model' is given to two columns"),
        ({}, {"OnStyl": "pen"}, "--methods OnStyl=pen: no line has it: one of OffKey"),
    ],
)
def test_a_renaming_of_what_is_not_there_is_named(table, columns, methods, said):
    with pytest.raises(BadRenaming) as error:
        read_observations(table(HEAD, "1,OffKey,1,yes,80,3,2,40"), columns, methods)
    assert said in str(error.value)
