"""`retouch run`: for which task and robot a skill is executed, and what is said before anything is started."""

import json

import numpy as np
import pytest

from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from lfd.store.stored import About, Binding, Purpose
from protocol.messages import ModelState
from services.cli import main
from services.commands import run
from services.model.shelf import Shelf


@pytest.fixture
def shelf(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    return Shelf(tmp_path / "retouch" / "robot1", "robot1")


@pytest.fixture
def launched(monkeypatch):
    """What would have been started."""
    started = []
    monkeypatch.setattr(run, "launch", lambda *given: started.append(given) or 0)
    return started


def skill(shelf, name, binding):
    shelf.new(name, About(binding))
    path = np.linspace((0.5, 0.0, 0.5), (0.8, 0.1, 0.6), 10)
    motion = Trajectory(path, np.tile((1.0, 0.0, 0.0, 0.0), (10, 1)), 5.0)
    with shelf.read(name) as store:
        store.add(Demonstration.reaching(motion, path[-1]), Purpose.INITIAL, binding)
    return name


def test_a_skill_is_executed_by_a_script_for_its_own_task_and_robot_and_nothing_is_taught(shelf, launched):
    assert main(["run", skill(shelf, "cups", Binding("table", "panda")), "--times", "7", "--operator", "anna"]) == 0
    ((settings, launch),) = launched
    assert (settings.robot.scene, settings.robot.model, settings.model.skill) == ("table", "panda", "cups")
    assert (settings.station.scripted, settings.station.executions, settings.operator) == (True, 7, "anna")
    assert (launch.headless, launch.untaught, launch.page, launch.router) == (True, True, False, True)


def test_the_variants_are_those_of_the_skills_task(shelf, launched, capsys):
    skill(shelf, "dots", Binding("particle", "particle"))
    assert main(["run", "dots", "--variant", "free"]) == 0
    assert launched[0][0].station.variant == "free"
    assert main(["run", "dots", "--variant", "b1"]) == 2
    assert "'particle' has no variant 'b1'" in capsys.readouterr().err


def test_where_another_machine_is_joined_its_model_is_asked_for_the_skill_and_only_a_station_starts(
    launched, monkeypatch
):
    asked = []
    held = ModelState(kind="adaptive", version=2, demonstrations=1, updates=1, scene="table", skill="cups")
    monkeypatch.setattr(run, "use", lambda settings, name: asked.append(name) or held)
    assert main(["run", "cups", "--connect", "tcp/127.0.0.1:7447"]) == 0
    ((settings, launch),) = launched
    assert asked == ["cups"]
    assert (launch.processes, launch.router, settings.station.executions) == (("station",), False, 10)
    assert settings.robot.scene == "table"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("nix",), "there is no skill 'nix'"),
        (("empty",), "has learnt nothing yet"),
        (
            ("cups", "--task", "dishwasher"),
            "skill 'cups' is for task table on tiago; this robot is tiago in dishwasher",
        ),
        (("cups", "--robot-model", "panda"), "skill 'cups' is for task table on tiago; this robot is panda in table"),
        (("cups", "--times", "10001"), "10000 at most"),
        (("cups", "--json", "/nowhere/at/all.json"), "/nowhere/at does not exist"),
    ],
)
def test_what_cannot_be_run_is_one_line_before_anything_is_started(shelf, launched, capsys, words, said):
    skill(shelf, "cups", Binding("table", "tiago"))
    shelf.new("empty", About(Binding("table", "tiago")))
    assert main(["run", *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
    assert launched == []


def test_a_damaged_skill_is_named(shelf, launched, capsys):
    shelf.path("torn").write_bytes(b"torn" * 100)
    assert main(["run", "torn"]) == 2
    assert "torn" in capsys.readouterr().err
    assert json.dumps(launched) == "[]"
