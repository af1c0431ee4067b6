"""The learning benchmark as a command, on recordings that are made up."""

import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[3]
POSE = ("x", "y", "z", "qw", "qx", "qy", "qz", "object_x", "object_y", "object_z")


def poses(target, bend):
    t = np.linspace(0.0, 1.0, 75)
    target = np.array(target)
    positions = np.outer(1.0 - t, [0.5, 0.0, 0.5]) + np.outer(t, target) + np.outer(np.sin(np.pi * t), [0.0, bend, 0.0])
    return [(*p, 1.0, 0.0, 0.0, 0.0, *target) for p in positions]


def write(path, header, rows):
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        csv.writer(file).writerows([header, *rows])


@pytest.fixture
def folder(tmp_path):
    """Two sets of demonstrations, and two corrections by each of two persons."""
    for name in ("first", "second"):
        for i, y in enumerate((-0.2, 0.0, 0.2)):
            rows = [(0.05 * k, *pose) for k, pose in enumerate(poses([0.9, y, 0.6], 0.1 * y))]
            write(tmp_path / "demonstrations" / name / f"{i}.csv", ("t", *POSE), rows)
    rows = []
    for person, bend in (("A", 0.1), ("B", 0.12)):
        for update in (1, 2):
            at = poses([0.9, 0.001 * update, 0.6], bend)
            rows += [(person, "by hand", 1, update, k, *pose) for k, pose in enumerate(at)]
    header = ("operator", "method", "model", "update", "sample", *POSE)
    write(tmp_path / "refinements" / "refinements.csv", header, rows)
    return tmp_path


def bench(folder, *arguments):
    initial = [folder / "demonstrations" / "first" / f"{i}.csv" for i in (0, 2)]
    command = [sys.executable, "-m", "tests.bench.learning", "--data", folder, "--initial", *initial, *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300.0, check=False)


@pytest.mark.sim
def test_the_report_tells_every_model_and_what_options_were_chosen_on(folder, tmp_path):
    report = tmp_path / "report.json"
    run = bench(folder, "--json", report)
    assert run.returncode == 0, run.stderr
    content = json.loads(report.read_text())
    assert content["tuned_on"] == {"sets": ["first"], "operators": ["A"]}
    names = {row["model"] for row in content["sets"]}
    assert {row["model"] for row in content["sequences"]} == {row["model"] for row in content["transfers"]} == names
    assert all(name.split()[0] in run.stdout for name in names)
    told = set(run.stdout.split())  # a name may take two lines of its cell
    assert all(set(figure["name"].split()) <= told for figure in content["figures"])


@pytest.mark.sim
def test_a_part_is_measured_alone(folder, tmp_path):
    report = tmp_path / "report.json"
    run = bench(folder, "--part", "report", "--json", report)
    assert run.returncode == 0, run.stderr
    content = json.loads(report.read_text())
    assert {row["name"] for row in content["sets"]} == {"second"}
    assert {row["sequence"][0] for row in content["sequences"]} == {"B"}
    assert content["transfers"] == []


@pytest.mark.sim
def test_a_folder_without_demonstrations_is_named(tmp_path):
    run = bench(tmp_path)
    assert run.returncode == 1
    assert run.stderr.startswith("bench: ")
    assert str(tmp_path) in run.stderr
    assert "Traceback" not in run.stderr
