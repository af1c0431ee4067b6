"""What is said without authority is counted, and told where it is a flood."""

import pytest

from services.robot.foreign import Foreign

SECOND = 1_000_000_000


@pytest.fixture
def foreign():
    foreign = Foreign()
    foreign.figure(10 * SECOND)
    return foreign


def said(foreign, count, process="master-eve"):
    for _ in range(count):
        foreign.heard(process)


def test_everything_so_far_is_counted(foreign):
    said(foreign, 3)
    assert (foreign.figure(11 * SECOND).value, foreign.figure(12 * SECOND).value) == (3.0, 3.0)


def test_who_waits_for_the_authority_is_no_news(foreign, caplog):
    said(foreign, 200)
    foreign.figure(11 * SECOND)
    assert caplog.records == []


def test_a_flood_is_told_with_how_much_and_of_whom(foreign, caplog):
    said(foreign, 2000, "master-\x1b[31m")
    foreign.figure(12 * SECOND)
    (record,) = caplog.records
    assert record.getMessage().startswith(
        "1000 messages a second come without authority, the last of them from 'master-"
    )
    assert "\x1b" not in record.getMessage()
