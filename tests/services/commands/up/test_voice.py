"""Whatever becomes of the terminal and the log, nobody who says something waits or fails."""

import contextlib
import logging
import os

import pytest

from services.commands.terminal import Terminal
from services.commands.up.voice import WAITING, Spoken, Voice

MORE_THAN_A_PIPE_HOLDS = 3 * WAITING


@pytest.fixture
def pipe():
    """The two ends of a pipe whose writer is a stream."""
    reader, writer = os.pipe()
    stream = os.fdopen(writer, "w", 1)
    yield reader, stream
    with contextlib.suppress(BrokenPipeError):
        stream.close()


def logged(path):
    return path.read_text(encoding="utf-8").splitlines()


def test_a_line_stands_on_the_terminal_and_in_the_log_with_its_name(tmp_path, pipe):
    reader, stream = pipe
    voice = Voice(Terminal(file=stream, width=20), tmp_path / "log.txt", live=False)
    voice.say("robot", "moves → there, and tells it at length")
    voice.close()
    assert os.read(reader, 1000).decode() == "     robot | moves → there, and tells it at length\n"
    assert logged(tmp_path / "log.txt")[0].endswith("robot: moves → there, and tells it at length")
    os.close(reader)


def test_what_the_supervisor_logs_is_said_as_what_its_processes_log(tmp_path, pipe):
    reader, stream = pipe
    voice = Voice(Terminal(file=stream, width=80), tmp_path / "log.txt", live=False)
    Spoken(voice).emit(logging.LogRecord("bus", logging.INFO, "", 0, "waiting for %s", ("a router",), None))
    voice.close()
    assert os.read(reader, 1000).decode() == "   retouch | INFO waiting for a router\n"
    os.close(reader)


def test_a_terminal_that_takes_nothing_holds_nobody_up(tmp_path, pipe):
    reader, stream = pipe
    voice = Voice(Terminal(file=stream), tmp_path / "log.txt", live=False)
    for number in range(MORE_THAN_A_PIPE_HOLDS):
        voice.say("robot", f"line {number}")
    voice.close()
    assert len(logged(tmp_path / "log.txt")) == MORE_THAN_A_PIPE_HOLDS
    os.close(reader)


def test_a_terminal_that_is_gone_holds_nobody_up(tmp_path, pipe):
    reader, stream = pipe
    os.close(reader)
    voice = Voice(Terminal(file=stream), tmp_path / "log.txt", live=True)
    for number in range(MORE_THAN_A_PIPE_HOLDS):
        voice.say("robot", f"line {number}")
    voice.close()
    assert len(logged(tmp_path / "log.txt")) == MORE_THAN_A_PIPE_HOLDS


def test_a_full_disk_ends_the_log_and_is_said_once(tmp_path, pipe):
    reader, stream = pipe
    (tmp_path / "log.txt").symlink_to("/dev/full")
    voice = Voice(Terminal(file=stream, width=200), tmp_path / "log.txt", live=False)
    for number in range(3):
        voice.say("robot", f"line {number}")
    voice.close()
    said = os.read(reader, 10_000).decode()
    assert said.count("No space left on device") == 1
    assert all(f"line {number}" in said for number in range(3))
    os.close(reader)
