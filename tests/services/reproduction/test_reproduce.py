"""The study's framework: what is kept, what is done again, and what the report says."""

import re

import pytest

from services.cli import main
from services.commands import reproduce as command
from services.commands.reproduce import Request, reproduce
from services.reproduction.analyses import ANALYSES
from services.reproduction.analysis import Analysis, Context, Figure, Finding, Holds, Row
from services.reproduction.exceptions import CannotKeep, UnknownAnalysis
from services.reproduction.report import html, shown
from services.reproduction.store import Done, Failed, Store
from services.reproduction.style import drawn, panels


class Counted:
    """An analysis that counts how often it has been made, and ends as it is told."""

    def __init__(self, name, error=None):
        self.runs = 0
        self.error = error
        self.analysis = Analysis(name, "Fig. 0", f"What is {name}?", "The thesis' words.", self.run)

    def run(self, context):
        self.runs += 1
        for _ in context.track(range(3)):
            if self.error is not None:
                raise self.error
        return finding(seed=context.seed)


def finding(**numbers):
    rows = tuple(Row(name, "m", "a text", value, None) for name, value in numbers.items())
    return Finding(Holds.YES, "As it says.", rows, (Figure("line", "A line.", b"<?xml ?><svg></svg>"),), ("A note.",))


@pytest.fixture
def ask(tmp_path):
    def ask_(*names, fresh=False, seed=0):
        return Request(names, tmp_path / "out", fresh=fresh, jobs=1, seed=seed)

    return ask_


@pytest.fixture
def report(tmp_path):
    return (tmp_path / "out" / "report.html").read_text


def test_what_is_done_is_done_once_until_it_is_asked_for_or_the_code_or_the_seed_change(ask, monkeypatch):
    one = Counted("one")
    runs = []
    for request in (ask(), ask(), ask(fresh=True), ask(seed=1), ask(seed=1)):
        assert reproduce(request, [one.analysis]) == 0
        runs.append(one.runs)
    monkeypatch.setattr(command, "code_key", lambda seed: "another version of the code")
    reproduce(ask(seed=1), [one.analysis])
    assert [*runs, one.runs] == [1, 1, 2, 3, 3, 4]


def test_one_that_fails_is_named_in_the_report_the_others_go_on_and_it_is_tried_again(ask, report):
    bad, good = Counted("bad", ValueError("not\n  <this> way")), Counted("good")
    analyses = [bad.analysis, good.analysis]
    assert reproduce(ask(), analyses) == 1
    assert "ValueError: not &lt;this&gt; way" in report()
    assert "As it says." in report()
    bad.error = None
    assert reproduce(ask(), analyses) == 0
    assert (bad.runs, good.runs) == (2, 1)


def test_an_interrupted_run_leaves_a_report_and_goes_on_where_it_was(ask, report):
    first, second = Counted("first"), Counted("second", KeyboardInterrupt())
    analyses = [first.analysis, second.analysis]
    with pytest.raises(KeyboardInterrupt):
        reproduce(ask(), analyses)
    assert "As it says." in report()
    assert "not run" in report()
    second.error = None
    assert reproduce(ask(), analyses) == 0
    assert (first.runs, second.runs) == (1, 2)


def test_a_record_that_is_broken_is_made_again(ask, tmp_path):
    one = Counted("one")
    reproduce(ask(), [one.analysis])
    for name, content in (("one.json", "{"), ("one-line.svg", None)):
        path = tmp_path / "out" / name
        path.write_text(content) if content else path.unlink()
        reproduce(ask(), [one.analysis])
    assert one.runs == 3


def test_single_analyses_are_chosen_by_name_and_earlier_ones_stay_in_the_report(ask, report):
    one, two = Counted("one"), Counted("two")
    analyses = [one.analysis, two.analysis]
    reproduce(ask("two"), analyses)
    assert (one.runs, two.runs) == (0, 1)
    reproduce(ask("one"), analyses)
    assert (one.runs, two.runs) == (1, 1)
    assert report().count("As it says.") == 2


def test_an_unknown_name_is_said_with_the_nearest(ask, capsys):
    with pytest.raises(UnknownAnalysis, match="'tow'; did you mean two"):
        reproduce(ask("tow"), [Counted("one").analysis, Counted("two").analysis])
    assert main(["reproduce", "wellford"]) == 2
    said = capsys.readouterr().err
    assert "did you mean welford?" in said
    assert said.count("\n") == 1


@pytest.mark.parametrize("flags", [["--jobs", "0"], ["--seed", "x"], ["--jobs", "-1"]])
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
    store = Store(tmp_path, "key")
    canvas, (axes,) = panels([""], solid=True)
    axes.plot([0, 1], [0, 1], [0, 1])
    raster = drawn(canvas, "raster", "Solid.", raster=True)
    kept = Finding(Holds.NO, "No.", (Row("q", "m", None, 0.5, "text"),), (raster, *finding().figures), ("note",))
    store.write("one", Done(kept, 1.5))
    assert store.read("one") == Done(kept, 1.5)
    store.write("one", Failed("reason"))
    assert store.read("one") == Failed("reason")
    assert Store(tmp_path, "another key").read("one") is None


def test_the_report_has_every_analysis_and_needs_nothing_but_itself():
    outcomes = {analysis.name: Done(finding(length=0.5), 1.0) for analysis in ANALYSES}
    text = html(ANALYSES, outcomes, seed=0)
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
    ],
)
def test_numbers_are_said_with_three_digits(value, unit, said):
    assert shown(value, unit) == said


def test_progress_reaches_its_end():
    shares = []
    assert list(Context(0, shares.append).track("abcd")) == list("abcd")
    assert shares == [0.0, 0.25, 0.5, 0.75, 1.0]


@pytest.mark.system
def test_two_at_once_in_processes_of_their_own(tmp_path, capfd):
    names = ["factor-ten", "welford"]
    assert main(["reproduce", *names, "--out", str(tmp_path), "--jobs", "2"]) == 0
    assert capfd.readouterr().out.strip() == str(tmp_path / "report.html")
    assert all(isinstance(Store(tmp_path, command.code_key(0)).read(name), Done) for name in names)
