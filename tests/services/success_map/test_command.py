"""What `retouch map` says of what cannot be mapped, each in one line, and a database of one's own."""

from dataclasses import replace

import msgspec
import numpy as np
import pytest

from lfd.motion.demonstration import Demonstration
from lfd.store.database import DemonstrationStore
from lfd.store.stored import Purpose
from services.cli import main
from services.model.learning import learn_all
from services.model.skill import binding_of
from services.reproduction.scripted import demonstrate
from services.success_map.conditions import (
    SuccessMap,
)
from sim.tasks import DISHWASHER
from tests.services.success_map.swift import shown_swiftly, swift


@pytest.fixture
def database(tmp_path):
    """Of a model with as many updates as asked for."""

    def database_(updates=0, initial=1, condition=None):
        path = tmp_path / "model.sqlite"
        shown = demonstrate(DISHWASHER, DISHWASHER.training_positions[0], None)
        if condition is not None:
            shown = Demonstration(shown.trajectory, shown.origin, np.array(condition))
        with DemonstrationStore(path) as store:
            for kind in [Purpose.INITIAL] * initial + [Purpose.UPDATE] * updates:
                store.add(shown, kind, binding_of(DISHWASHER))
        return str(path)

    return database_


def said(capsys, *flags):
    """The only line that a refusal says."""
    try:
        code = main(["map", *flags])
    except SystemExit as ended:
        code = ended.code
    assert code == 2
    (line,) = capsys.readouterr().err.splitlines()
    return line


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (["--grid", "0"], "--grid: must be a whole number, at least 1"),
        (["--grid", "3", "--samples", "4"], "not allowed with"),
        (["--samples", "many"], "--samples: must be a whole number"),
        (["--spread", "-0.1"], "--spread: must be metres, from 0 to 0.5"),
        (["--spread", "nan"], "--spread: must be metres"),
        (["--kind", "dmp"], "invalid choice: 'dmp'"),
        (["--jobs", "0"], "--jobs: must be a whole number"),
        (["--scene", "kitchen"], "kitchen"),
        (["--corrections", "2"], "--corrections, --at, --people and --scatter say how to teach: give --teach too"),
        (["--teach", "--corrections", "2", "--at", "0.86,0.2,0.553"], "--corrections 2 at 1 places: give as many --at"),
        (["--teach", "--at", "here"], "--at: must be numbers in metres"),
        (["--teach", "--at", "2.0,0.2,0.553"], "beyond where targets of scene"),
        (["--teach", "--people", "0"], "--people: must be a whole number"),
        (["--variant", "b3"], "b3"),
        (["--before", "2"], "--before takes back updates of a database"),
        (["--teach", "--database", "x.sqlite"], "leave out --database, or --teach"),
        (["--database", "nowhere.sqlite"], "there is no file nowhere.sqlite"),
        (["--out", "map.pdf"], "--out must name a .png file"),
        (["--out", "nowhere/map.png"], "--out: the folder nowhere does not exist"),
        (["--json", "nowhere/map.json"], "--json: the folder nowhere does not exist"),
    ],
)
def test_a_wrong_flag_is_one_line_before_anything_is_simulated(flags, words, capsys, tmp_path, monkeypatch):
    monkeypatch.setattr("services.commands.map.first_demonstrations", lambda _: pytest.fail("it simulates"))
    monkeypatch.chdir(tmp_path)
    assert words in said(capsys, *flags)
    assert list(tmp_path.iterdir()) == []


def test_a_database_that_cannot_be_mapped_is_one_line(database, capsys):
    assert "holds no demonstration" in said(capsys, "--database", database(initial=0))


def test_a_database_with_fewer_updates_is_one_line(database, capsys):
    assert "takes back more than the 2 updates" in said(capsys, "--database", database(updates=2), "--before", "3")


def test_a_model_of_another_condition_is_one_line(database, capsys):
    assert "more than the target's place" in said(capsys, "--database", database(condition=[1.0, 2.0]))


def test_a_model_that_began_with_its_updates_has_no_stage_before_all_of_them(database, capsys):
    assert "knows no motion" in said(capsys, "--database", database(initial=0, updates=1))


def test_a_database_of_another_scene_is_one_line_with_both(database, capsys):
    line = said(capsys, "--database", database(updates=1), "--scene", "table")
    assert "dishwasher" in line
    assert "table" in line


@pytest.mark.sim
def test_a_database_without_its_last_update_and_with_it(tmp_path, capsys):
    database = tmp_path / "model.sqlite"
    with DemonstrationStore(database) as store:
        for demonstration in shown_swiftly(DISHWASHER):
            store.add(demonstration, Purpose.INITIAL, binding_of(DISHWASHER))
        # The second basket position's way, as a correction would lead.
        for position in DISHWASHER.training_positions:
            led = demonstrate(DISHWASHER, position, None, variant="b2")
            led = replace(led, trajectory=swift(led.trajectory))
            store.add(led, Purpose.UPDATE, binding_of(DISHWASHER))
        assert learn_all("adaptive", store.active()) is not None
    out, json = tmp_path / "map.png", tmp_path / "map.json"
    flags = ["--before", "2", "--grid", "1", "--spread", "0", "--jobs", "1", "--out", str(out), "--json", str(json)]
    assert main(["map", "--database", str(database), *flags]) == 0
    found = msgspec.json.decode(json.read_bytes(), type=SuccessMap)
    assert found.corrections == (0, 2)
    said = capsys.readouterr()
    assert f"after 2 corrections: {found.reachable} of {found.reachable} reachable" in said.err
    assert "before: 0 (0.0 %, 95 % interval" in said.err
    assert said.out.strip() == str(out)
    assert out.read_bytes().startswith(b"\x89PNG")
