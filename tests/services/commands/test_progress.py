"""How far work has come is told where no bar can be drawn, too."""

import io

import pytest
from rich.console import Console

from services.commands.progress import share_bar


@pytest.mark.parametrize("steps", [10, 72, 1000])
def test_where_there_is_no_terminal_each_tenth_is_a_line(steps):
    out = io.StringIO()
    with share_bar(Console(file=out), "18 people") as progress:
        for step in range(1, steps + 1):
            progress(step / steps)
    assert out.getvalue().splitlines() == [f"18 people: {percent} %" for percent in range(10, 101, 10)]


def test_work_that_leaps_tells_where_it_is():
    out = io.StringIO()
    with share_bar(Console(file=out), "work") as progress:
        for share in (0.05, 0.55, 0.55, 1.0):
            progress(share)
    assert out.getvalue().splitlines() == ["work: 50 %", "work: 100 %"]
