import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


def bench(*arguments):
    command = [sys.executable, "-m", "tests.bench.lfd", *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300.0, check=False)


@pytest.mark.sim
def test_the_benchmark_measures_every_group_and_needs_no_other_library(tmp_path):
    report = tmp_path / "report.json"
    run = bench("--quick", "--no-peers", "--json", str(report))
    assert run.returncode == 0, run.stderr
    results = json.loads(report.read_text())
    timed = [r for r in results if r.get("runs")]
    for operation in ("fit", "condition", "update", "time warping", "prediction"):
        assert [r["name"] for r in timed if r["operation"].startswith(operation)]
    assert all(0.0 < r["least"] <= r["value"] <= r["p99"] for r in timed)
    assert all(r["note"] for r in results if r.get("runs") == 0)
    assert all(r["name"] in run.stdout for r in results)


@pytest.mark.sim
def test_a_report_that_could_not_be_written_is_refused_before_the_work(tmp_path):
    run = bench("--json", str(tmp_path / "nowhere" / "report.json"))
    assert run.returncode == 2
    assert "does not exist" in run.stderr
    assert "Traceback" not in run.stderr
