"""A recording on a disk that does not take it: said at once, readable up to then, and gone on with."""

import contextlib
import logging
import os
import shutil
import subprocess
import threading
import warnings
from pathlib import Path

import pytest

from services.process.exceptions import FolderUnusable

pytestmark = pytest.mark.sim

FULL_BYTES = 4 * 2**20


@pytest.fixture
def disk(tmp_path):
    """A file system of 4 MiB."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={FULL_BYTES}", "tmpfs", str(folder)]
    if shutil.which("mount") is None or subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("a small file system cannot be mounted here: that takes root's right")
    yield folder
    subprocess.run(["umount", "--lazy", str(folder)], check=True)


@pytest.fixture
def record():
    """A function that begins a recording in a folder; it is checked by hand."""
    from services.viewer.parts import Parts

    begun = []

    def record_(folder):
        begun.append(Parts(folder, "testbed", "abc", check_s=0.0))
        return begun[-1]

    yield record_
    for parts in begun:
        parts.close(1.0)


def log(parts, first, count=10, size=0):
    """Log numbers from `first` on, each with so many bytes beside it."""
    import rerun as rr

    for i in range(first, first + count):
        parts.stream.set_time("time", duration=float(i))
        parts.stream.log("/number", rr.Scalars([float(i)]))
        if size:
            parts.stream.log("/weight", rr.EncodedImage(contents=os.urandom(size), media_type="image/jpeg"))


def numbers(path):
    from rerun.chunk import RrdReader

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a file that broke off has no footer, and the SDK says so
        batches = [chunk.to_record_batch().to_pydict() for chunk in RrdReader(str(path)).stream()]
    return sorted(n for batch in batches for row in batch.get("Scalars:scalars", ()) for n in row)


def fill(disk):
    """Take what room there is, down to the last byte."""
    ballast = disk / "ballast"
    with contextlib.suppress(OSError), ballast.open("wb", buffering=0) as file:
        while True:
            file.write(bytes(4096))
    return ballast


def test_a_full_disk_is_noticed_at_the_next_check_and_named_once_in_the_log(disk, record, caplog):
    parts = record(disk)
    log(parts, 0)
    parts.check()
    fill(disk)
    log(parts, 10, size=8192)
    with caplog.at_level(logging.WARNING):
        parts.check()
        parts.check()
    assert "no space left on device" in parts.fault
    assert str(parts.path) in parts.fault
    assert parts.stream is None
    assert [record.message for record in caplog.records] == [parts.fault]


def test_what_was_recorded_before_the_disk_was_full_is_readable(disk, record):
    parts = record(disk)
    log(parts, 0)
    parts.check()
    fill(disk)
    log(parts, 10, size=8192)
    parts.check()
    assert numbers(parts.path)[:10] == [float(i) for i in range(10)]


def test_with_room_again_it_goes_on_in_a_new_file_that_stands_by_itself(disk, record):
    import rerun as rr

    parts = record(disk)
    parts.paint("name", lambda stream: stream.log("/standing", rr.Scalars([-1.0]), static=True))
    log(parts, 0)
    ballast = fill(disk)
    log(parts, 10, size=8192)
    parts.check()
    ballast.unlink()
    parts.check()
    assert parts.fault == ""
    assert parts.number == 2
    log(parts, 20)
    parts.check()
    second = parts.path.with_name(f"{parts.path.stem}-2.rrd")
    assert numbers(second) == [-1.0, *(float(i) for i in range(20, 30))]
    assert parts.size == parts.path.stat().st_size + second.stat().st_size


def test_while_the_disk_stays_full_no_further_file_is_begun(disk, record):
    parts = record(disk)
    fill(disk)
    log(parts, 0, size=8192)
    for _ in range(5):
        parts.check()
    assert parts.fault
    assert sorted(path.name for path in disk.iterdir()) == ["ballast", parts.path.name]


def test_a_removed_folder_is_noticed_and_recording_goes_on_in_it(tmp_path, record):
    parts = record(tmp_path / "runs")
    log(parts, 0)
    parts.check()
    shutil.rmtree(tmp_path / "runs")
    log(parts, 10)
    parts.check()
    assert "the file was removed" in parts.fault
    assert parts.size >= 0
    parts.check()
    assert parts.fault == ""
    log(parts, 20)
    parts.check()
    assert numbers(parts.path.with_name(f"{parts.path.stem}-2.rrd")) == [float(i) for i in range(20, 30)]


def test_a_folder_that_is_gone_with_what_it_lay_in_is_not_made_anew(tmp_path, record):
    stick = tmp_path / "stick"
    parts = record(stick / "runs")
    shutil.rmtree(stick)
    for _ in range(3):
        parts.check()
    assert parts.fault
    assert not stick.exists()


def test_what_was_checked_survives_a_kill(tmp_path, record):
    parts = record(tmp_path)
    log(parts, 0)
    parts.check()
    copied = shutil.copy(parts.path, tmp_path / "as_if_killed.rrd")
    assert numbers(copied) == [float(i) for i in range(10)]


class Watched(type(Path())):
    """A path whose file is looked at after every write: how long it is, and how much of that is whole messages."""

    def open(self, mode="r", **settings):
        file = super().open(mode, **settings)
        return Watching(file, self) if mode == "xb" else file


class Watching:
    def __init__(self, file, path):
        self.file, self.path, self.lengths = file, path, []

    def write(self, piece):
        from services.viewer.framing import whole_length

        written = self.file.write(piece)
        if written:
            self.lengths.append((self.path.stat().st_size, whole_length(self.path)))
        return written

    def close(self):
        self.file.close()


def test_a_kill_at_any_time_leaves_whole_messages_however_large_they_are(tmp_path):
    import rerun as rr

    from services.viewer.part import Part

    part = Part(Watched(tmp_path / "large.rrd"), "abc")
    for size in (10, 2**19, 10, 2**20):
        part.stream.log("/weight", rr.EncodedImage(contents=os.urandom(size), media_type="image/jpeg"))
        part.stream.flush()
    part.close(5.0)
    lengths = part._file.lengths
    assert len(lengths) >= 4
    assert all(length == whole for length, whole in lengths)


def test_a_disk_that_is_kept_busy_is_no_disk_that_does_not_answer(tmp_path, record):
    parts = record(tmp_path)
    stop = threading.Event()

    def keep_busy():
        n = 0
        while not stop.is_set():
            log(parts, n, count=1, size=2**17)
            parts.stream.flush()
            n += 1

    busy = threading.Thread(target=keep_busy)
    busy.start()
    for _ in range(3):
        parts.check()
    stop.set()
    busy.join()
    assert parts.fault == ""


def test_a_disk_that_does_not_answer_is_said_to_until_it_does(tmp_path, record, monkeypatch):
    """As a network's disk whose server is away: what is written to it comes back when the server does."""
    from services.viewer import part

    answers = threading.Event()
    write = part.Part._write
    monkeypatch.setattr(part, "_HUNG_S", 0.2)
    monkeypatch.setattr(part.Part, "_write", lambda self, piece: (answers.wait(30.0) and write(self, piece)) or "")
    parts = record(tmp_path)
    for first in (0, 10, 20):
        if parts.stream is not None:
            log(parts, first)
        parts.check()
        assert "the disk does not answer" in parts.fault
        assert parts.stream is None
    answers.set()
    parts.check()
    assert parts.fault == ""
    log(parts, 30)
    parts.check()
    assert parts.fault == ""


def test_whoever_asks_how_large_a_recording_is_waits_for_no_disk(tmp_path, record, monkeypatch):
    """The viewer says so in its own step: a disk that does not answer must not keep it from saying that."""
    parts = record(tmp_path)
    log(parts, 0)
    parts.check()
    size = parts.path.stat().st_size
    looked = []
    monkeypatch.setattr(Path, "stat", lambda *_, **__: looked.append(threading.current_thread()))
    assert parts.size == size
    assert looked == []
    monkeypatch.undo()


def test_rows_of_a_second_lie_in_one_chunk(tmp_path, record):
    from rerun.chunk import RrdReader

    parts = record(tmp_path)
    for second in range(3):
        log(parts, 30 * second, count=30)
        parts.check()
    parts.close(1.0)
    rows = [chunk.num_rows for chunk in RrdReader(str(parts.path)).stream() if chunk.entity_path == "/number"]
    assert rows == [30, 30, 30]


def test_a_file_that_is_closed_is_whole(tmp_path, record):
    from services.viewer.web_files import sdk_program

    parts = record(tmp_path)
    log(parts, 0)
    parts.close(1.0)
    verify = [sdk_program(), "rrd", "verify", str(parts.path)]
    verified = subprocess.run(verify, capture_output=True, text=True, timeout=60, check=False)
    assert verified.returncode == 0, verified.stderr


def test_a_folder_that_cannot_be_written_to_is_named_with_its_setting(tmp_path, record):
    (tmp_path / "runs").write_text("a file")
    with pytest.raises(FolderUnusable, match=r"\[viewer\] folder"):
        record(tmp_path / "runs")
