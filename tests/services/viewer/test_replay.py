"""`retouch replay`: one clear line where it cannot, and what is whole of a recording that breaks off."""

import subprocess
import types
from pathlib import Path

import pytest

from services.viewer.exceptions import CannotReplay
from services.viewer.replay import replay
from tests.services.viewer.framed import recording


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(CannotReplay, match=r"nowhere\.rrd: No such file"):
        replay(tmp_path / "nowhere.rrd")


def test_a_file_that_is_no_recording_is_not_opened(tmp_path):
    path = tmp_path / "notes.rrd"
    path.write_text("notes")
    with pytest.raises(CannotReplay, match="not a Rerun recording"):
        replay(path)


def test_without_a_display_the_line_says_so(tmp_path, monkeypatch):
    path = tmp_path / "run.rrd"
    path.write_bytes(b"RRF2")
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    with pytest.raises(CannotReplay, match="no display"):
        replay(path)


@pytest.fixture
def opened(tmp_path, monkeypatch):
    """What Rerun is given to open: its path, and its content at that moment."""
    given = []

    def run(command, **_):
        path = Path(command[-1])
        given.append((path, path.read_bytes()))
        return types.SimpleNamespace(returncode=0, stderr="")

    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(subprocess, "run", run)
    return given


def test_a_recording_that_is_whole_is_opened_as_it_is(tmp_path, opened):
    path = recording(tmp_path / "run.rrd", messages=2)
    replay(path)
    assert opened == [(path, path.read_bytes())]


def test_of_one_that_breaks_off_within_a_message_the_rest_is_opened_and_the_file_left_alone(tmp_path, opened, caplog):
    path = recording(tmp_path / "run.rrd", messages=2)
    whole = path.read_bytes()
    path.write_bytes(whole + whole[12:30])
    replay(path)
    ((copy, content),) = opened
    assert content == whole
    assert copy != path
    assert path.read_bytes() == whole + whole[12:30]
    assert "breaks off: its last 18 bytes are not shown" in caplog.text


def test_a_recording_of_an_older_kind_is_opened_as_it_is(tmp_path, opened):
    path = tmp_path / "old.rrd"
    path.write_bytes(b"RRF1" + bytes(40))
    replay(path)
    assert opened == [(path, path.read_bytes())]
