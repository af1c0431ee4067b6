"""The product's Python, and every Python that it starts, is blind to other projects."""

import os
import subprocess
import sys

from services.process.isolation import ROOT, isolate_children, retouch_command


def test_a_command_is_this_very_code_blind_to_the_working_folder_and_pythons_variables():
    command = retouch_command(("robot", "--debug"))
    assert command[:4] == [sys.executable, "-I", "-X", "utf8"]
    assert command[4] == str(ROOT / "services" / "__main__.py")
    assert command[5:] == ["robot", "--debug"]


def test_a_python_that_a_library_starts_is_blind_to_them_too(tmp_path, monkeypatch):
    (tmp_path / "sim.py").write_text("print('foreign')")
    monkeypatch.chdir(tmp_path)
    for name in [name for name in os.environ if name.startswith("PYTHON")]:
        monkeypatch.delenv(name)
    for name, value in {"PYTHONPATH": str(tmp_path), "PYTHONHOME": "/nonexistent", "PYTHONWARNINGS": "error"}.items():
        monkeypatch.setenv(name, value)
    for name in ("PYTHONSAFEPATH", "PYTHONNOUSERSITE", "PYTHONUTF8"):
        monkeypatch.setenv(name, "")  # put back after the test
    isolate_children()
    told = subprocess.run([sys.executable, "-c", "import sim"], capture_output=True, text=True, check=True)
    assert told.stdout + told.stderr == ""
