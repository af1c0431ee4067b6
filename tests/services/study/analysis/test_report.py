"""The report and its files: whole, by themselves, and true to the figures."""

import csv
import json
import re
from pathlib import Path

import msgspec
import numpy as np
import pytest

from services.cli import main
from services.process.written import read
from services.study.analysis.analysis import analysed
from services.study.analysis.exceptions import NothingToAnalyse
from services.study.analysis.hypotheses import Hypothesis, Measure, Plan
from services.study.analysis.numerals import equals, exactly, figure, p_value
from services.study.analysis.observations import Observations, Outcome
from services.study.analysis.report import REPORT, report
from services.study.analysis.reporting import Reporting, appendix
from tests.services.study.analysis.studies import METHODS, changed, study


def table(path, observations):
    """The observations as anybody's table."""
    workload = {(one.participant, one.method): one.workload for one in observations.ratings}
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("participant", "method", "model", "position", "adapted", "seconds", "workload"))
        for one in observations.outcomes:
            seconds = repr(one.seconds) if one.adapted else ""
            load = workload[one.participant, one.method]
            writer.writerow((one.participant, one.method, one.model, one.position, one.adapted, seconds, load))


def rows(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    observations = study(np.random.default_rng(0), online=1.6, easier=6.0)
    said = tuple(msgspec.structs.replace(one, field="=<b>1</b>") for one in observations.backgrounds)
    observations = msgspec.structs.replace(observations, backgrounds=said)
    shares = []
    analysis = report(folder / "deep" / "out", observations, Plan(), Reporting(title="A title"), shares.append)
    return folder / "deep" / "out", observations, analysis, shares


def test_the_report_needs_no_other_file(made):
    text = (made[0] / REPORT).read_text()
    assert "<h1>A title</h1>" in text
    assert not re.search(r"(src|href)=\"(?!data:|#)", text)
    assert text.count("data:image/svg+xml") >= 6
    for name in ("Participants", "Hypotheses", "Mixed models", "Learning", "Methods paragraph", "Reporting appendix"):
        assert name in text


def test_the_tables_hold_every_observation_and_every_test(made):
    folder, observations, analysis, _ = made
    outcomes = rows(folder / "outcomes.csv")
    assert len(outcomes) == len(observations.outcomes)
    assert float(outcomes[0]["seconds"]) in {one.seconds for one in observations.outcomes}
    assert len(rows(folder / "ratings.csv")) == len(observations.ratings)
    tests = rows(folder / "tests.csv")
    assert [float(one["p"]) for one in tests] == [one.test.p for one in analysis.results]
    assert rows(folder / "summary.csv")[0]["method"] == "OnStyl"


def test_the_numbers_are_there_as_json(made):
    found = json.loads((made[0] / "analysis.json").read_text())
    assert found["flow"]["participants"] == 18
    assert [one["test"]["p"] for one in found["results"]] == [one.test.p for one in made[2].results]


def test_progress_rises_to_the_end(made):
    assert made[3] == sorted(made[3])
    assert made[3][-1] == 1.0


def test_whoever_is_synthetic_is_marked_everywhere(made):
    folder, text = made[0], (made[0] / REPORT).read_text()
    assert "Synthetic participants: no person took part." in text
    assert len(re.findall(r"<figcaption>Synthetic participants\. ", text)) == text.count("<figcaption>")
    for name in ("outcomes.csv", "ratings.csv", "participants.csv", "summary.csv", "tests.csv"):
        assert {one["synthetic"] for one in rows(folder / name)} == {"yes"}
    assert "synthetic participants (no person took part)" in text


def test_what_nobody_gave_is_said_to_be_not_given():
    observations = study(np.random.default_rng(1), people=5, synthetic=False)
    items = {one.name: one for one in appendix(observations, analysed(observations, Plan()), Reporting(consent="yes"))}
    assert items["Recruitment"].text == "not given"
    assert items["Consent"].given
    assert items["Gender"].text == "woman: 5"
    assert re.fullmatch(r"median \d+, \d+ to \d+ years", items["Age"].text)


def test_text_of_a_participant_is_no_markup_and_no_formula(made):
    text = (made[0] / REPORT).read_text()
    assert "<b>1</b>" not in text
    assert "&amp;" not in text, "nor is it escaped twice"
    assert rows(made[0] / "participants.csv")[0]["field"] == "'=<b>1</b>"


@pytest.mark.parametrize("rules", ["retouch", "thesis"])
def test_little_data_make_a_report_as_well(tmp_path, rules):
    observations = changed(
        study(np.random.default_rng(3), people=2, models=1),
        lambda one: msgspec.structs.replace(one, position=None, refinements=None, updates=None),
    )
    bare = msgspec.structs.replace(observations, backgrounds=(), ratings=(), synthetic=False)
    report(tmp_path, bare, Plan(rules=rules))
    assert "too few" in (tmp_path / REPORT).read_text()


def test_a_single_hypothesis_and_no_test_of_backgrounds_are_said_as_such(tmp_path):
    one = Hypothesis("x", Measure.SECONDS, METHODS[:1], METHODS[1:2])
    observations = study(np.random.default_rng(12), people=5)
    said = tuple(msgspec.structs.replace(b, age="") for b in observations.backgrounds)
    report(tmp_path, msgspec.structs.replace(observations, backgrounds=said), Plan(hypotheses=(one,)))
    text = (tmp_path / REPORT).read_text()
    assert "One confirmatory hypothesis (" in text
    assert "1 confirmatory hypotheses" not in text
    assert "of 0 tests" not in text
    assert "of the other hypotheses" not in text, "there are none"


def test_a_study_in_which_everybody_fails_makes_a_report(tmp_path):
    failed = changed(
        study(np.random.default_rng(4)), lambda one: msgspec.structs.replace(one, adapted=False, seconds=None)
    )
    report(tmp_path, failed, Plan())
    assert "nobody has a value on both sides" in (tmp_path / REPORT).read_text()


def test_nothing_that_can_be_analysed_is_said_in_a_line():
    nothing = Observations(outcomes=(Outcome(participant="1", method="a", model=1, adapted=False),), source="x.csv")
    with pytest.raises(NothingToAnalyse, match=r"x\.csv holds neither a refinement time nor a workload"):
        analysed(nothing, Plan())


def test_the_thesis_rules_say_what_is_wrong_with_them(tmp_path):
    report(tmp_path, study(np.random.default_rng(5)), Plan(rules="thesis"))
    text = (tmp_path / REPORT).read_text()
    assert "What is wrong with these rules" in text
    assert "The same hypotheses with the participant as the unit" in text


def test_the_command_writes_the_report_of_a_plan_and_says_what_came_out(tmp_path, capsys):
    table(tmp_path / "data.csv", study(np.random.default_rng(6), online=2.0))
    plan, out = tmp_path / "plan.toml", tmp_path / "out"
    plan.write_text(
        'alpha = 0.01\n[[hypotheses]]\nname = "mine"\nmeasure = "workload"\n'
        'first = ["OnKey"]\nsecond = ["OffKey"]\ndirection = "different"\nsmallest = 5.0\n'
    )
    assert main(["study", "analyse", str(tmp_path / "data.csv"), "--plan", str(plan), "--out", str(out)]) == 0
    said = capsys.readouterr()
    assert said.out.strip() == str(out / REPORT)
    assert "18 participants; 18 in the refinement time, 0 excluded" in said.err
    assert {one["hypothesis"] for one in rows(out / "tests.csv")} == {"mine"}


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--columns", "seconds"), "must be OURS=THEIRS"),
        (("--methods", "OnStyl=pen"), "no line has it"),
        (("--plan", "nowhere.toml"), "plan nowhere.toml: No such file or directory"),
    ],
)
def test_wrong_input_is_one_line_and_exit_code_two(tmp_path, capsys, arguments, said):
    table(tmp_path / "data.csv", study(np.random.default_rng(8), people=3))
    try:
        code = main(["study", "analyse", str(tmp_path / "data.csv"), "--out", str(tmp_path / "out"), *arguments])
    except SystemExit as end:
        code = end.code
    error = capsys.readouterr().err
    assert code == 2
    assert said in error
    assert error.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_a_method_of_others_is_named_before_anything_is_written(tmp_path, capsys):
    other = changed(
        study(np.random.default_rng(9), people=3), lambda one: msgspec.structs.replace(one, method=one.method.lower())
    )
    other = msgspec.structs.replace(
        other, ratings=tuple(msgspec.structs.replace(one, method=one.method.lower()) for one in other.ratings)
    )
    table(tmp_path / "data.csv", other)
    assert main(["study", "analyse", str(tmp_path / "data.csv"), "--out", str(tmp_path / "out")]) == 2
    assert "'OnStyl', which is not in the data" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_two_hypotheses_of_one_name_are_refused():
    twice = (Hypothesis("x", Measure.SECONDS, METHODS[:1], METHODS[1:2]),) * 2
    with pytest.raises(Exception, match="two hypotheses are called 'x'"):
        analysed(study(np.random.default_rng(10), people=3), Plan(hypotheses=twice))


def test_the_example_of_a_plan_is_one():
    plan = read(Path(__file__).parents[4] / "deploy/examples/analysis.toml", Plan, "plan")
    assert [one.confirmatory for one in plan.hypotheses] == [True, True, False]


def test_numbers_are_said_as_papers_do():
    assert [figure(one) for one in (None, 0.5, 12.34, 345.6, -0.001)] == ["–", "0.50", "12.3", "346", "0.00"]
    assert [p_value(one) for one in (0.0004, 0.0312, None)] == ["< 0.001", "0.031", "–"]
    assert exactly(7.938e-12) == "7.94 · 10⁻¹²"
    assert [equals("< 0.001"), equals("0.5")] == ["< 0.001", "= 0.5"]
