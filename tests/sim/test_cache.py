"""What takes long to make is made once, wherever there is a place for it, and said where it is another one."""

import logging

import pytest

from sim import cache
from sim.cache import VARIABLE, kept
from sim.exceptions import CacheUnusable


class Making:
    """Makes a file, and counts how often."""

    def __init__(self, error=None):
        self.times = 0
        self.error = error

    def __call__(self, part, target):
        self.times += 1
        part.write_text(str(target))
        if self.error is not None:
            raise self.error


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """The machine's folder for temporary files."""
    folder = tmp_path / "tmp"
    folder.mkdir()
    monkeypatch.setattr(cache.tempfile, "gettempdir", lambda: str(folder))
    return folder


@pytest.fixture
def unusable(tmp_path, monkeypatch, temporary):
    """The user's cache folder cannot be made."""
    (tmp_path / "file").write_text("")
    monkeypatch.setenv(VARIABLE, str(tmp_path / "file"))


def test_it_is_made_once_and_told_where_it_lies(tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    making = Making()
    assert kept("thing", making) == kept("thing", making) == tmp_path / "retouch" / "thing"
    assert making.times == 1
    assert (tmp_path / "retouch" / "thing").read_text() == str(tmp_path / "retouch" / "thing")
    assert [path.name for path in (tmp_path / "retouch").iterdir()] == ["thing"]


def test_a_cache_that_cannot_be_used_is_named_once_with_its_variable_and_a_temporary_one_taken(
    tmp_path, temporary, unusable, caplog
):
    making = Making()
    with caplog.at_level(logging.WARNING):
        place = kept("thing", making)
        assert kept("thing", making) == place
    assert temporary in place.parents
    assert making.times == 1
    (record,) = caplog.records
    assert VARIABLE in record.getMessage()
    assert str(tmp_path / "file") in record.getMessage()


def test_a_full_disk_leaves_nothing_and_is_passed_over(tmp_path, temporary, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(tmp_path / "full"))

    class Full(Making):
        def __call__(self, part, target):
            super().__call__(part, target)
            if target.is_relative_to(tmp_path / "full"):
                raise OSError(28, "No space left on device")

    assert temporary in kept("thing", Full()).parents
    assert list((tmp_path / "full" / "retouch").iterdir()) == []


def test_a_folder_that_is_asked_for_is_the_only_one(tmp_path, temporary):
    with pytest.raises(CacheUnusable):
        kept("thing", Making(OSError(28, "No space left on device")), tmp_path)
    assert list(temporary.iterdir()) == []


def test_no_place_at_all_is_one_line_with_the_variable(temporary, unusable):
    with pytest.raises(CacheUnusable, match=VARIABLE):
        kept("thing", Making(OSError(28, "No space left on device")))


def test_what_another_user_could_have_put_there_is_not_trusted(temporary, unusable):
    foreign = next(folder for folder in cache._folders() if temporary in folder.parents)
    foreign.chmod(0o777)
    with pytest.raises(CacheUnusable):
        kept("thing", Making())


def test_a_relative_variable_is_passed_over_as_the_specification_says(tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, "relative")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert kept("thing", Making()) == tmp_path / ".cache" / "retouch" / "thing"
