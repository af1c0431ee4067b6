"""The README's example runs as it stands there, from the example files to a picture."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import lfd

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "deploy" / "examples"
(EXAMPLE,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)

pytestmark = pytest.mark.sim  # draws, which takes a second to load


def test_the_readmes_example_makes_its_picture(tmp_path):
    (tmp_path / "deploy").symlink_to(ROOT / "deploy")
    environment = {**os.environ, "MPLBACKEND": "Agg", "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-W", "error", "-c", EXAMPLE]
    done = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=120, check=False
    )
    # On a machine that has not drawn yet Matplotlib may say that it builds its font cache.
    told = [line for line in done.stderr.splitlines() if "font cache" not in line]
    assert (done.returncode, told) == (0, [])
    picture = (tmp_path / "corrected.png").read_bytes()
    assert picture.startswith(b"\x89PNG")
    assert int.from_bytes(picture[16:20], "big") == 900


def test_the_examples_correction_is_learnt():
    """What the picture shows: at its own place the corrected prediction is the correction."""
    shown = [
        lfd.read_demonstration(file, condition_columns=["object_y"]) for file in sorted(EXAMPLES.glob("reach-*.csv"))
    ]
    correction = lfd.read_demonstration(EXAMPLES / "correction.csv", condition_columns=["object_y"])
    model = lfd.AdaptiveProMP.fit(shown)
    n = correction.trajectory.n_points
    before, after = (
        known.predict(correction.situation, n).trajectory.positions for known in (model, model.updated(correction))
    )
    gap = np.linalg.norm(before - correction.trajectory.positions, axis=1).max()
    assert gap > 0.1
    assert np.linalg.norm(after - correction.trajectory.positions, axis=1).max() < 0.1 * gap
