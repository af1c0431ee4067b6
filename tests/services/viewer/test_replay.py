"""`retouch replay`: one clear line where it cannot."""

import pytest

from services.viewer.exceptions import CannotReplay
from services.viewer.replay import replay


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
