"""A file is written whole or not at all, and only where a file belongs."""

import os

import pytest

from services.process.exceptions import FolderUnusable
from services.process.files import data_folder, settings_folder, state_folder, write_whole


def test_what_is_written_is_all_there_and_nothing_is_left_beside(tmp_path):
    write_whole(tmp_path / "a", b"one")
    write_whole(tmp_path / "a", b"two")
    assert (tmp_path / "a").read_bytes() == b"two"
    assert [path.name for path in tmp_path.iterdir()] == ["a"]


def test_a_failure_leaves_what_was_there(tmp_path, monkeypatch):
    write_whole(tmp_path / "a", b"one")

    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space"):
        write_whole(tmp_path / "a", b"two")
    assert (tmp_path / "a").read_bytes() == b"one"
    assert [path.name for path in tmp_path.iterdir()] == ["a"]


def test_a_link_stays_a_link(tmp_path):
    (tmp_path / "folder").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "folder" / "file")
    write_whole(tmp_path / "link", b"one")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "folder" / "file").read_bytes() == b"one"


def test_what_is_no_file_is_not_replaced_by_one(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "pipe", tmp_path):
        with pytest.raises(OSError, match="Not a file"):
            write_whole(path, b"one")
    assert (tmp_path / "pipe").is_fifo()


@pytest.mark.parametrize(
    ("folder", "variable"),
    [(data_folder, "XDG_DATA_HOME"), (state_folder, "XDG_STATE_HOME"), (settings_folder, "XDG_CONFIG_HOME")],
    ids=["data", "state", "settings"],
)
class TestFolders:
    """Where a user's files belong."""

    def test_the_variable_decides(self, folder, variable, tmp_path, monkeypatch):
        monkeypatch.setenv(variable, str(tmp_path / "there"))
        assert folder() == tmp_path / "there" / "retouch"
        assert folder().is_dir()

    def test_without_it_the_home_folder_does(self, folder, variable, tmp_path, monkeypatch):
        monkeypatch.delenv(variable, raising=False)
        monkeypatch.setenv("HOME", str(tmp_path))
        assert tmp_path in folder().parents

    @pytest.mark.parametrize("value", ["/dev/null", "relative/folder"])
    def test_one_that_cannot_be_is_named_with_its_variable(self, folder, variable, value, monkeypatch):
        monkeypatch.setenv(variable, value)
        with pytest.raises(FolderUnusable, match=rf"{value}.*{variable}"):
            folder()

    def test_nobodys_home_is_named_with_the_variable_too(self, folder, variable, monkeypatch):
        monkeypatch.delenv(variable, raising=False)
        monkeypatch.setattr("services.process.files.Path.home", lambda: (_ for _ in ()).throw(RuntimeError("no home")))
        with pytest.raises(FolderUnusable, match=variable):
            folder()
