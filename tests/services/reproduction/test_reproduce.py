"""The framework: what is kept, what is done again, and what the report says."""

import re

import pytest

from services.cli import main
from services.commands import reproduce as command
from services.commands.reproduce import Request, estimated, reproduce
from services.offline.proportion import Proportion
from services.reproduction.analyses import ANALYSES
from services.reproduction.analysis import Analysis, Claim, Context, Figure, Finding, Relation, Row, Source
from services.reproduction.exceptions import CannotKeep, UnknownAnalysis
from services.reproduction.numerals import bounded, interval, shown
from services.reproduction.report import Entry, html
from services.reproduction.store import Done, Failed, Run, Store
from services.reproduction.style import drawn, panels
from services.reproduction.summary import Estimate, judged
from services.reproduction.work import pieces_of


class Counted:
    """An analysis that notes whom it was made with, and ends as it is told."""

    def __init__(self, name, error=None, value=1.0, *, person=True):
        self.seeds = []
        self.error = error
        self.value = value
        self.analysis = Analysis(name, "Fig. 0", f"What is {name}?", "The thesis' words.", self.run, 1.0, person)

    def run(self, context):
        self.seeds.append(context.seed)
        for _ in context.track(range(3)):
            if self.error is not None:
                raise self.error
        return finding(self.value, illustrated=context.illustrated)


def finding(value=1.0, *, illustrated=True):
    claim = Claim(Source.RETOUCH, "It is small.", "length", value, Relation.BELOW, 2.0, unit="m")
    row = Row("length", {"promp": value, "adaptive": 0.5}, "m", "a text", headline=True)
    figures = (Figure("line", "A line.", b"<?xml ?><svg></svg>"),) if illustrated else ()
    return Finding((claim,), (row,), figures, ("A note.",))


@pytest.fixture
def ask(tmp_path):
    def ask_(*names, fresh=False, seed=0, people=1):
        return Request(names, tmp_path / "out", fresh=fresh, people=people, seed=seed, jobs=1)

    return ask_


@pytest.fixture
def report(tmp_path):
    return (tmp_path / "out" / "report.html").read_text


def test_what_is_done_is_done_once_until_it_is_asked_for_or_the_code_changes(ask, monkeypatch):
    one = Counted("one")
    made = []
    for request in (ask(), ask(), ask(fresh=True), ask(people=3), ask(people=2, seed=1)):
        one.seeds.clear()
        assert reproduce(request, [one.analysis]) == 0
        made.append(list(one.seeds))
    # The first of other people is made again, with figures.
    assert made == [[0], [], [0], [1, 2], [1]]
    monkeypatch.setattr(command, "code_key", lambda: "another version of the code")
    one.seeds.clear()
    reproduce(ask(people=3), [one.analysis])
    assert one.seeds == [0, 1, 2]


def test_one_run_says_it_all_where_nobody_takes_part(ask):
    one = Counted("one", person=False)
    assert reproduce(ask(people=5), [one.analysis]) == 0
    assert one.seeds == [0]


def test_one_that_fails_is_named_in_the_report_the_others_go_on_and_it_is_tried_again(ask, report):
    bad, good = Counted("bad", ValueError("not\n  <this> way")), Counted("good")
    analyses = [bad.analysis, good.analysis]
    assert reproduce(ask(people=2), analyses) == 1
    assert "2 of 2 runs could not be made: ValueError: not &lt;this&gt; way" in report()
    assert "It is small." in report()
    bad.error = None
    assert reproduce(ask(people=2), analyses) == 0
    assert (bad.seeds, good.seeds) == ([0, 1] * 2, [0, 1])


def test_a_claim_that_does_not_hold_is_a_result_that_is_counted(ask, report, capsys):
    one, two = Counted("one", value=3.0, person=False), Counted("two", person=False)
    assert reproduce(ask(), [one.analysis, two.analysis]) == 0
    assert "claims that hold: 1, that do not: 1" in " ".join(capsys.readouterr().err.split())
    assert "What does not hold" in report()
    assert "Found: length 3 m, not &lt; 2 m." in report()


def test_too_few_people_leave_a_claim_undecided(ask, capsys):
    assert reproduce(ask(people=3), [Counted("one").analysis]) == 0
    assert "claims that hold: 0, that do not: 0, undecided: 1, which more --people may decide" in " ".join(
        capsys.readouterr().err.split()
    )


def test_an_interrupted_run_leaves_a_report_and_goes_on_where_it_was(ask, report):
    first, second = Counted("first"), Counted("second", KeyboardInterrupt())
    analyses = [first.analysis, second.analysis]
    with pytest.raises(KeyboardInterrupt):
        reproduce(ask(people=2), analyses)
    assert "It is small." in report()
    assert "analysis without a result" in report()
    second.error = None
    assert reproduce(ask(people=2), analyses) == 0
    assert (first.seeds, second.seeds) == ([0, 1], [0, 0, 1])


def test_a_record_that_is_broken_is_made_again(ask, tmp_path):
    one = Counted("one")
    reproduce(ask(), [one.analysis])
    for name, content in (("one-0.json", "{"), ("one-0-line.svg", None)):
        path = tmp_path / "out" / name
        path.write_text(content) if content else path.unlink()
        reproduce(ask(), [one.analysis])
    assert one.seeds == [0] * 3


def test_single_analyses_are_chosen_by_name_and_earlier_ones_stay_in_the_report(ask, report):
    one, two = Counted("one"), Counted("two")
    analyses = [one.analysis, two.analysis]
    reproduce(ask("two"), analyses)
    assert (one.seeds, two.seeds) == ([], [0])
    reproduce(ask("one"), analyses)
    assert (one.seeds, two.seeds) == ([0], [0])
    assert report().count("It is small.") == 2


def test_how_long_it_takes_is_said_at_the_beginning(ask, capsys):
    analysis = Counted("one").analysis
    todo = pieces_of(analysis, range(20))
    assert (estimated(todo, 1), estimated(todo, 4), estimated([], 2)) == (20.0, 5.0, 0.0)
    reproduce(ask(people=2), [analysis])
    assert "2 runs to make; about 1 min on 1 idle core" in " ".join(capsys.readouterr().err.split())


def test_an_unknown_name_is_said_with_the_nearest(ask, capsys):
    with pytest.raises(UnknownAnalysis, match="'tow'; did you mean two"):
        reproduce(ask("tow"), [Counted("one").analysis, Counted("two").analysis])
    assert main(["reproduce", "wellford"]) == 2
    said = capsys.readouterr().err
    assert "did you mean welford?" in said
    assert said.count("\n") == 1


@pytest.mark.parametrize("flags", [["--jobs", "0"], ["--seed", "x"], ["--jobs", "-1"], ["--people", "0"]])
def test_a_wrong_number_is_one_line(flags, capsys):
    with pytest.raises(SystemExit, match="2"):
        main(["reproduce", *flags])
    assert capsys.readouterr().err.count("\n") == 1


def test_the_list_names_every_analysis(capsys):
    assert main(["reproduce", "--list"]) == 0
    said = capsys.readouterr().out
    assert all(re.search(rf"^{analysis.name}\b", said, re.MULTILINE) for analysis in ANALYSES)


def test_a_folder_that_cannot_be_is_one_line(ask, tmp_path):
    (tmp_path / "out").write_text("a file")
    with pytest.raises(CannotKeep, match="--out"):
        reproduce(ask(), [Counted("one").analysis])


def test_what_is_kept_is_what_is_read(tmp_path):
    store, run = Store(tmp_path, "key"), Run("one", 3, illustrated=True)
    canvas, (axes,) = panels([""], solid=True)
    axes.plot([0, 1], [0, 1], [0, 1])
    raster = drawn(canvas, "raster", "Solid.", raster=True)
    row = Row("q", {"promp": 0.5, "dmp": True, "adaptive": "text"}, "m", total=4.0)
    kept = Finding(finding().claims, (row,), (raster, *finding().figures), ("note",))
    store.write(run, Done(kept, 1.5))
    assert store.read(run) == Done(kept, 1.5)
    store.write(run, Failed("reason"))
    assert store.read(run) == Failed("reason")
    assert Store(tmp_path, "another key").read(run) is None


def test_the_report_has_every_analysis_and_needs_nothing_but_itself():
    seeds = range(2)
    entries = [
        Entry.of(one, {piece.run: Done(finding(), 1.0) for piece in pieces_of(one, seeds)}, seeds) for one in ANALYSES
    ]
    text = html(entries, seeds)
    for analysis in ANALYSES:
        assert f'id="{analysis.name}"' in text
        assert f'href="#{analysis.name}"' in text
    sources = re.findall(r'(?:src|href)="([^"]{0,20})', text)
    assert sources
    assert all(source.startswith(("data:", "#")) for source in sources)
    assert "url(" not in text


def test_names_are_fit_for_a_command_line_and_unique():
    names = [analysis.name for analysis in ANALYSES]
    assert len(set(names)) == len(names)
    assert all(re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", name) for name in names)


@pytest.mark.parametrize(
    ("value", "unit", "said"),
    [
        (None, "m", "–"),
        ("a text", "m", "a text"),
        (0.0, "m", "0 m"),
        (0.12345, "m", "0.123 m"),
        (-12.345, "", "−12.3"),
        (3.0, "updates", "3 updates"),
        (1234.5, "mm", "1234 mm"),
        (2.1e-16, "", "2.1 · 10⁻¹⁶"),
        (2.1e-16, "mm", "0 mm"),
        (float("inf"), "", "inf"),
        (True, "", "yes"),
        (1, "", "1"),
        (Proportion(0, 1), "", "no"),
        (Proportion(1, 20), "", "1 of 20"),
        (Estimate(0.5, 0.4, 0.6, 20), "m", "0.500 m"),
    ],
)
def test_numbers_are_said_with_three_digits(value, unit, said):
    assert shown(value, unit) == said


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (None, ""),
        (3.0, ""),
        (Proportion(1, 1), ""),
        (Proportion(20, 20), "84–100 %"),
        (Estimate(0.5, 0.5, 0.5, 1), ""),
        (Estimate(1.0, 1.0, 1.0, 20), ""),
        (Estimate(0.5, 0.412, 0.588, 20), "0.412–0.588"),
    ],
)
def test_intervals_are_said_where_there_are_any(value, said):
    assert interval(value, "m") == said


def test_a_bound_is_said_with_what_it_is():
    claim = Claim(Source.RETOUCH, "Less.", "length", 1.0, Relation.BELOW, 2.5, against="DMP", unit="mm")
    assert bounded(judged([claim], person=False)) == "< 2.50 mm (DMP)"


def test_progress_reaches_its_end():
    shares = []
    assert list(Context(0, shares.append).track("abcd")) == list("abcd")
    assert shares == [0.0, 0.25, 0.5, 0.75, 1.0]


def test_figures_are_drawn_only_where_they_are_wanted():
    figures = finding().figures
    assert Context(0).drawn(lambda: figures) == figures
    assert Context(0, illustrated=False).drawn(lambda: 1 / 0) == ()


@pytest.mark.system
def test_two_at_once_in_processes_of_their_own(tmp_path, capfd):
    name = "time-warping"
    assert main(["reproduce", name, "--out", str(tmp_path), "--jobs", "2", "--people", "2"]) == 0
    assert capfd.readouterr().out.strip() == str(tmp_path / "report.html")
    store = Store(tmp_path, command.code_key())
    assert all(isinstance(store.read(Run(name, seed, seed == 0)), Done) for seed in range(2))
