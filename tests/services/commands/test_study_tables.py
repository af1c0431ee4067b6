"""What the study's commands print as tables is read on a terminal of 80 columns, and tells how sure a share is."""

import io
import re

import numpy as np
import pytest
from rich.console import Console

from services.cli import main
from services.commands.study import grouped
from services.commands.study.analyse import summarise
from services.process.exit_codes import Exit
from services.study.analysis.analysis import analysed
from services.study.analysis.hypotheses import Plan
from services.study.protocols import SHIPPED
from services.study.study import new_study
from tests.services.study.analysis.studies import study

WIDTH = 80


def test_a_name_has_its_line_and_columns_stand_below_their_heads():
    out = io.StringIO()
    grouped.show(Console(file=out), ["", "n"], {"a [red]name[/] of its own": [["x", "7"], ["long", "12"]]})
    assert out.getvalue().splitlines() == [
        "         n",
        "a [red]name[/] of its own",
        "     x   7",
        "  long  12",
    ]


@pytest.mark.parametrize("rules", ["retouch", "thesis"])
def test_the_tests_of_an_analysis_fit_the_terminal(rules):
    out, observations = io.StringIO(), study(np.random.default_rng(3), online=1.6, easier=30.0)
    plan = Plan(rules=rules)
    summarise(analysed(observations, plan), Console(file=out, width=WIDTH))
    lines = out.getvalue().splitlines()[1:]
    assert max(map(len, lines)) <= WIDTH
    assert len(lines) == 1 + 2 * len(plan.hypotheses)
    assert {one.name for one in plan.hypotheses} <= set(lines)


@pytest.mark.parametrize(("studies", "told"), [(10, True), (60, False)])
def test_few_studies_tell_an_interval(tmp_path, capsys, studies, told):
    folder = new_study(tmp_path / "study", SHIPPED["thesis"]).folder
    flags = ("--people", "2", "--effects", "0", "--studies", str(studies), "--jobs", "1")
    assert main(["study", "power", str(folder), *flags]) == Exit.DONE
    said = capsys.readouterr().out
    assert ("95 % intervals" in said) is told
    assert bool(re.search(r"\d% \(\d+-\d+\)", said)) is told
    assert max(map(len, said.splitlines())) <= WIDTH
