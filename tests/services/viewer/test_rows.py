"""Rows on their way to a stream: each in time, many in a chunk."""

import pytest

from tests.services.viewer.read import Read

pytestmark = pytest.mark.sim

TICK_NS = 33_333_333


@pytest.fixture
def part(tmp_path):
    from services.viewer.part import Part

    part = Part(tmp_path / "rows.rrd", "abc")
    yield part
    part.close(1.0)


def gather(every_s, ticks):
    """Rows of this many ticks, and after how many of them they were due first."""
    from services.viewer.kinds import SCALARS
    from services.viewer.rows import Rows

    rows, due = Rows(every_s), []
    for tick in range(ticks):
        rows.add("/number", SCALARS, [float(tick), -1.0], tick / 30, tick * TICK_NS)
        rows.add("/other", SCALARS, [0.0] * (1 + tick % 2), tick / 30, tick * TICK_NS)
        if rows.due(tick * TICK_NS):
            due.append(tick)
    return rows, due[0] if due else None


def test_rows_are_due_when_the_first_of_them_has_waited_for_long_enough():
    _, due = gather(0.15, 10)
    assert due == 5


def test_each_entitys_rows_are_one_chunk(part):
    rows, _ = gather(1.0, 20)
    rows.send(part.stream)
    part.close(1.0)
    read = Read(part.path)
    assert read.moving("/number") == [20]
    assert read.values("/number") == [[float(tick), -1.0] for tick in range(20)]
    assert [len(numbers) for numbers in read.values("/other")] == [1, 2] * 10


def test_what_was_sent_is_not_sent_again(part):
    rows, _ = gather(1.0, 3)
    rows.send(part.stream)
    rows.send(part.stream)
    part.close(1.0)
    assert Read(part.path).moving("/number") == [3]


def test_without_a_stream_rows_are_let_go(part):
    rows, _ = gather(1.0, 3)
    rows.send(None)
    rows.send(part.stream)
    part.close(1.0)
    assert Read(part.path).entities.isdisjoint({"/number", "/other"})


def test_where_something_is_lies_scalar_last(part):
    from protocol.messages import Pose
    from services.viewer.kinds import POSES
    from services.viewer.rows import Rows

    rows = Rows(1.0)
    rows.add("/pose", POSES, Pose((1.0, 2.0, 3.0), (0.5, 0.5, -0.5, 0.5)), 0.0, 0)
    rows.send(part.stream)
    part.close(1.0)
    assert Read(part.path).values("/pose", "Transform3D:quaternion") == [[[0.5, -0.5, 0.5, 0.5]]]
