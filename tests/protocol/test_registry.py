"""The registry is whole, and the README shows it as it is."""

import re
from pathlib import Path

import pytest

from protocol.exceptions import InvalidName
from protocol.names import checked_name
from protocol.queries import QUERIES
from protocol.table import query_table, topic_table
from protocol.topics import CAMERA_IMAGE, TOPICS

CLASSES = {"cmd", "state", "model", "cam", "safety", "authority", "health"}
README = Path(__file__).resolve().parents[2] / "README.md"


def test_names_are_unique():
    names = [t.name for t in TOPICS] + [q.name for q in QUERIES]
    assert len(set(names)) == len(names)


def test_every_name_is_a_class_and_a_subject():
    for one in (*TOPICS, *QUERIES):
        class_, subject, *member = one.name.split("/")
        assert class_ in CLASSES
        assert member in ([], ["*"])
        assert re.fullmatch("[a-z_]+", subject)


def test_every_topic_becomes_stale_after_ten_periods_or_never():
    for topic in TOPICS:
        if topic.stale_after_ns is not None:
            assert topic.stale_after_ns == int(max(0.1, 10.0 / topic.rate_hz) * 1e9)


def test_a_key_carries_version_robot_class_subject_and_source():
    topic = next(t for t in TOPICS if t.name == "cmd/master_state")
    assert topic.key("arm-1", "master") == "retouch/@v1/arm-1/cmd/master_state/master"


def test_a_member_of_a_family_has_a_name_of_its_own():
    side = CAMERA_IMAGE.of("side")
    assert side == CAMERA_IMAGE.of("side") != CAMERA_IMAGE.of("head")
    assert side.key("arm-1", "camera") == "retouch/@v1/arm-1/cam/image/side/camera"
    with pytest.raises(InvalidName):
        CAMERA_IMAGE.of("a/b")


@pytest.mark.parametrize("name", ["", "a/b", "*", "a b", "-a", "é", "x" * 65, "$*", "a\n"])
def test_a_name_that_is_no_chunk_is_refused(name):
    with pytest.raises(InvalidName):
        checked_name(name)


@pytest.mark.parametrize("table", [topic_table, query_table])
def test_the_readme_shows_the_registry(table):
    assert table() in README.read_text(encoding="utf-8")
