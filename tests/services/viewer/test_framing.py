"""A file ends behind a whole message, whatever it came in."""

import pytest

from services.viewer.framing import Whole, whole_length
from tests.services.viewer.framed import recording


@pytest.mark.parametrize("size", [1, 7, 12, 16, 64, 1000])
def test_pieces_are_let_through_by_whole_messages_and_nothing_is_lost(tmp_path, size):
    content = recording(tmp_path / "all.rrd", messages=6).read_bytes()
    whole, through = Whole(), b""
    for begin in range(0, len(content), size):
        through += whole.add(content[begin : begin + size])
        if through:
            (tmp_path / "so_far.rrd").write_bytes(through)
            assert whole_length(tmp_path / "so_far.rrd") == len(through)
    assert through == content
    assert whole.rest() == b""


def test_what_is_held_at_the_end_is_the_rest(tmp_path):
    content = recording(tmp_path / "all.rrd", messages=2).read_bytes()
    whole = Whole()
    assert whole.add(content + b"RRF2FOOT") == content
    assert whole.rest() == b"RRF2FOOT"


@pytest.mark.parametrize("beyond", [0, 1, 15, 16, 35])
def test_the_whole_length_ends_behind_the_last_whole_message(tmp_path, beyond):
    path = recording(tmp_path / "cut.rrd", messages=2)
    whole = path.read_bytes()
    path.write_bytes(whole + whole[12:][:beyond])
    assert whole_length(path) == len(whole)


def test_a_footer_belongs_to_the_file(tmp_path):
    path = recording(tmp_path / "whole.rrd", messages=2)
    path.write_bytes(path.read_bytes() + bytes(20) + b"RRF2FOOT" + bytes(4))
    assert whole_length(path) == path.stat().st_size


def test_a_file_without_a_message_is_its_header(tmp_path):
    path = tmp_path / "short.rrd"
    path.write_bytes(b"RRF2")
    assert whole_length(path) == 4
