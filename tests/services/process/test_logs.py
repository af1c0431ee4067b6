"""Whoever logs never waits for whoever reads."""

import logging
import threading

import pytest

from services.process.logs import Unhurried

WITHIN_S = 10.0


class Reader:
    """A stream whose reader takes nothing until s/he is told to."""

    def __init__(self):
        self.taken = []
        self.asked = threading.Event()
        self.takes = threading.Event()

    def write(self, text):
        self.asked.set()
        assert self.takes.wait(WITHIN_S)
        self.taken.append(text)

    def flush(self):
        """Nothing is kept back."""


@pytest.fixture
def reader():
    slow = Reader()
    yield slow
    slow.takes.set()


def said(handler, *lines):
    for line in lines:
        handler.handle(logging.makeLogRecord({"msg": line, "levelno": logging.WARNING}))


def test_lines_wait_for_a_reader_and_come_in_their_order(reader):
    handler = Unhurried(reader)
    said(handler, "one", "two")
    assert reader.taken == []
    reader.takes.set()
    handler.flush()
    assert reader.taken == ["one\n", "two\n"]


def test_what_there_is_no_room_for_is_counted(reader):
    handler = Unhurried(reader, waiting=1)
    said(handler, "one")
    assert reader.asked.wait(WITHIN_S)
    said(handler, "two", "three", "four")
    reader.takes.set()
    handler.flush()
    assert reader.taken == ["one\n", "WARNING 2 lines were left out: nobody took them\ntwo\n"]


def test_a_stream_that_is_closed_ends_nothing(tmp_path):
    stream = (tmp_path / "log").open("w")
    stream.close()
    handler = Unhurried(stream)
    said(handler, "one", "two")
    handler.flush()
    assert stream.closed


def test_what_is_said_again_and_again_is_counted_and_buries_nothing(reader):
    handler = Unhurried(reader)
    reader.takes.set()
    said(handler, *["the authority was lost"] * 265, "nothing is recorded")
    handler.flush()
    *lost, fault, count = reader.taken
    assert (lost, fault) == (["the authority was lost\n"] * 3, "nothing is recorded\n")
    assert count.startswith("262 more like this")
