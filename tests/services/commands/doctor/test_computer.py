"""A computer that has more to do than it can is a finding by itself."""

import threading

import pytest

from services.commands.doctor.case import Case
from services.commands.doctor.computer import check_computer
from services.process.clock import ManualClock
from services.process.config import Configuration
from services.process.load import Load


def found(load):
    return [
        one.line for one in check_computer(Case(Configuration(), ManualClock(), threading.Event(), load=lambda: load))
    ]


@pytest.mark.parametrize("load", [None, Load(8.0, 2)])
def test_of_a_computer_that_keeps_up_nothing_is_said(load):
    assert found(load) == []


def test_one_that_is_too_busy_is_to_be_looked_at():
    (line,) = found(Load(22.4, 2))
    assert line.startswith("look at this")
    assert "too busy: 22 programs want its 2 processors; motions will hold" in line
