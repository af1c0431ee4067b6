"""An exported skill comes back bit by bit, and predicts the same; what is not as it was written does not come back."""

import math

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lfd.store.database import DemonstrationStore
from protocol import queries
from protocol.messages import Purpose
from protocol.queries import Undo
from services.commands.skill.files import bring_in
from services.model import export
from services.model.exceptions import ExportUnusable, SkillError
from services.model.export import exported, read_export
from services.model.shelf import Shelf
from tests.services.model.rig import Rig, positions


@pytest.fixture(scope="module")
def skill(tmp_path_factory):
    """A skill with everything in it: its file, what is exported of it, and what it predicts."""
    path = tmp_path_factory.mktemp("skill") / "cups.sqlite"
    rig = Rig(path)
    rig.teach(Purpose.INITIAL)
    rig.teach(Purpose.INITIAL, at=(0.8, -0.1, 0.55), operator="anna")
    rig.teach(Purpose.UPDATE, bend=0.1, operator="anna", alpha=0.5)
    rig.teach(Purpose.UPDATE, bend=0.05)
    rig.ask(queries.UNDO, Undo(entry=4, operator="ben"))
    predicted = positions(rig.predict())
    rig.service.close()
    with DemonstrationStore(path) as store:
        whole = store.whole()
    return whole, exported("cups", whole), predicted


@pytest.fixture
def file(tmp_path, skill):
    path = tmp_path / "cups.retouch-skill"
    path.write_bytes(skill[1])
    return path


@pytest.fixture
def shelf(tmp_path):
    return Shelf(tmp_path / "robot1", "robot1")


def test_what_is_imported_is_what_was_exported_bit_by_bit_and_predicts_the_same(tmp_path, shelf, file, skill):
    whole, _, predicted = skill
    bring_in(shelf, file, "other")
    with shelf.read("other") as store:
        found = store.whole()
    assert found[1:] == whole[1:]
    assert found.about == whole.about._replace(used_s=None)
    rig = Rig(shelf.path("other"))
    np.testing.assert_array_equal(positions(rig.predict()), predicted)
    rig.service.close()


def test_what_is_exported_of_what_was_imported_is_the_same_file(shelf, file, skill):
    bring_in(shelf, file, None)
    with shelf.read("cups") as store:
        assert exported("cups", store.whole()) == skill[1]


@settings(max_examples=300, deadline=None)
@given(st.data())
def test_a_byte_that_is_another_one_anywhere_is_refused(tmp_path_factory, skill, data):
    content = bytearray(skill[1])
    where = data.draw(st.integers(0, 60) | st.integers(0, len(content) - 1))
    content[where] ^= data.draw(st.integers(1, 255))
    path = tmp_path_factory.mktemp("flipped") / "cups"
    path.write_bytes(content)
    with pytest.raises(ExportUnusable) as caught:
        read_export(path)
    assert "\n" not in str(caught.value)


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_one_that_breaks_off_or_goes_on_is_refused(tmp_path_factory, skill, data):
    cut = data.draw(st.integers(0, 60) | st.integers(0, len(skill[1]) - 1))
    for content in (skill[1][:cut], skill[1] + bytes(cut + 1)):
        path = tmp_path_factory.mktemp("cut") / "cups"
        path.write_bytes(content)
        with pytest.raises(ExportUnusable):
            read_export(path)


def test_another_version_says_what_to_do(file, skill, monkeypatch):
    monkeypatch.setattr(export, "VERSION", 2)
    file.write_bytes(exported("cups", skill[0]))
    monkeypatch.setattr(export, "VERSION", 1)
    with pytest.raises(ExportUnusable, match="version 2 is not 1; update Retouch"):
        read_export(file)


def test_what_is_larger_than_any_export_is_not_read(file, skill, monkeypatch):
    monkeypatch.setattr(export, "LARGEST", 1000)
    with pytest.raises(ExportUnusable, match="larger than"):
        read_export(file)
    with pytest.raises(ExportUnusable, match="larger than"):
        exported("cups", skill[0])


def _changed(content, **values):
    content["demonstrations"][0]["values"].update(values)


def _array(content, **changed):
    next(one for one in content["demonstrations"][0]["arrays"] if one["name"] == "positions").update(changed)


_WRONG = {
    "a motion of another shape": lambda c: _array(c, shape="7,3"),
    "a shape that is none": lambda c: _array(c, shape="much"),
    "another number format": lambda c: _array(c, dtype="|O"),
    "an array twice": lambda c: _array(c, name="origin"),
    "a motion that is not finite": lambda c: _array(c, data=np.full((40, 3), np.nan).tobytes()),
    "a duration that is none": lambda c: _changed(c, duration=-1.0),
    "an infinite duration": lambda c: _changed(c, duration=math.inf),
    "a text for a number": lambda c: _changed(c, duration="long"),
    "a number that no file holds": lambda c: _changed(c, added=2**63),
    "a purpose that nobody knows": lambda c: _changed(c, kind="wish"),
    "a method that nobody knows": lambda c: _changed(c, method="magic"),
    "a column that nobody knows": lambda c: _changed(c, colour="blue"),
    "half a departure": lambda c: _changed(c, departure_mean=0.1, departure_most=None),
    "a version twice": lambda c: _changed(c, added=2),
    "no version": lambda c: c["demonstrations"][0]["values"].pop("added"),
    "a demonstration of another task in use": lambda c: _changed(c, scene="table"),
    "no changes": lambda c: c.update(changes=[]),
    "a change of what is not there": lambda c: c["changes"].append(
        {**c["changes"][0], "demonstration": 9, "version": 9}
    ),
    "something beside": lambda c: c.update(run="rm"),
}


@pytest.mark.parametrize("wrong", _WRONG)
def test_what_was_written_so_and_is_no_skill_leaves_nothing(shelf, file, wrong):
    """Whoever wrote it knew how to make a digest."""
    content = msgspec.msgpack.decode(file.read_bytes()[export._BEFORE :])
    _WRONG[wrong](content)
    file.write_bytes(_framed(msgspec.msgpack.encode(content)))
    with pytest.raises(ExportUnusable) as caught:
        bring_in(shelf, file, "other")
    assert str(file) in str(caught.value)
    assert "\n" not in str(caught.value)
    assert (shelf.names(), [one.name for one in shelf.folder.iterdir()]) in (([], [".skills.lock"]), ([], []))


def test_nested_or_other_content_is_no_skill(shelf, file):
    for content in (b"", b"\x91" * 100_000, b"\xdd\xff\xff\xff\xff", msgspec.msgpack.encode({"name": "cups"})):
        file.write_bytes(_framed(content))
        with pytest.raises(ExportUnusable):
            bring_in(shelf, file, None)


@pytest.mark.parametrize("name", ["cups", "CUPS", "../cups", ""])
def test_an_import_never_touches_what_is_there(shelf, file, name):
    bring_in(shelf, file, None)
    before = shelf.path("cups").read_bytes()
    with pytest.raises(SkillError):
        bring_in(shelf, file, name)
    assert shelf.path("cups").read_bytes() == before
    assert shelf.names() == ["cups"]


def _framed(content: bytes) -> bytes:
    head = export._HEAD.pack(export.VERSION, len(content))
    return export._MAGIC + head + export.hashlib.sha256(head + content).digest() + content
