"""`retouch task list`, `new`, `check` and `draw`: what a person reads, and which pictures lie there."""

from pathlib import Path

import numpy as np
import pytest

from services.cli import main
from services.commands.task.bases import STEP, placements
from sim.robots.catalogue import robot
from sim.tasks import REACHING, scene

pytestmark = pytest.mark.sim


@pytest.fixture(scope="module")
def fresh(tmp_path_factory):
    path = tmp_path_factory.mktemp("task") / "my-task.toml"
    assert main(["task", "new", str(path)]) == 0
    return path


def test_those_that_ship_are_listed_a_line_each(capsys):
    assert main(["task", "list"]) == 0
    assert [line.partition(":")[0] for line in capsys.readouterr().out.splitlines()] == list(REACHING)


def test_a_new_one_goes_by_its_files_name_and_has_nothing_missing(fresh, tmp_path, capsys):
    assert main(["task", "check", str(fresh), "--robot-model", "panda", "--out", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert "ways: found for panda; the one through wall is" in said
    assert "100% of start and region are reached" in said
    assert {path.name for path in tmp_path.glob("*.png")} == {"my-task-open.png", "my-task-wall.png"}


def test_nothing_is_written_over(fresh, capsys):
    assert main(["task", "new", str(fresh)]) == 2
    assert "it is there already" in capsys.readouterr().err
    assert main(["task", "new", "mine"]) == 2


def test_what_is_missing_is_a_line_each(fresh, tmp_path, capsys):
    path = tmp_path / "bad.toml"
    text = fresh.read_text().replace("id = 7", "id = 70").replace("[0.68, 0.20, 0.56]", "[0.98, 0.20, 0.56]")
    path.write_text(text)
    assert main(["task", "check", str(path)]) == 2
    said = capsys.readouterr().out.splitlines()
    assert said == [
        "objects jar: unknown tag 70: DICT_4X4_50 has 0 to 49",
        "training_places, number 2: [0.98, 0.2, 0.56] is outside the region of jar",
    ]


def test_a_start_that_no_arm_reaches_and_a_place_out_of_reach_are_told(fresh, tmp_path, capsys):
    path = tmp_path / "far.toml"
    path.write_text(fresh.read_text().replace("position = [0.56, -0.26, 0.63]", "position = [1.56, -0.26, 0.63]"))
    assert main(["task", "check", str(path), "--robot-model", "panda"]) == 2
    assert "start: panda does not reach it" in capsys.readouterr().out
    path.write_text(fresh.read_text().replace("upper = [0.72, 0.22, 0.56]", "upper = [1.92, 0.22, 0.56]"))
    assert main(["task", "check", str(path), "--robot-model", "panda"]) == 2
    assert "region: panda does not reach an object at [1.92, 0.06, 0.56]" in capsys.readouterr().out


def test_the_base_is_proposed_where_all_of_it_is_reached(fresh):
    there = placements(scene(str(fresh), robot("panda")))
    assert there.best is not None
    assert there.shares[np.argmin(np.linalg.norm(there.bases - there.best, axis=1))] == 1.0
    assert there.shares.min() < 1.0, "from too far away it is not"
    assert np.linalg.norm(there.bases[0] - there.bases[1]) == pytest.approx(STEP)


def test_a_task_is_named_or_it_is_said_which_there_are(capsys):
    assert main(["task", "check"]) == 2
    assert "dishwasher, table, post" in capsys.readouterr().err
    assert main(["task", "draw", "particle"]) == 2


def test_the_picture_alone_shows_both_arrangements(fresh, tmp_path: Path):
    assert main(["task", "draw", "table", "--out", str(tmp_path)]) == 0
    assert {path.name for path in tmp_path.glob("*.png")} == {"table-clear.png", "table-box.png"}
