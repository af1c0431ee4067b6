"""A machine is too busy where many more programs want its processors than there are."""

import os

import pytest

from services.process.load import Load, load_now


@pytest.mark.parametrize(("wanting", "processors", "too_much"), [(8.0, 2, False), (8.1, 2, True), (22.0, 8, False)])
def test_four_programs_a_processor_are_borne(wanting, processors, too_much):
    assert Load(wanting, processors).is_too_much is too_much


def test_this_machine_s_load_is_that_of_the_last_minute(monkeypatch):
    monkeypatch.setattr(os, "getloadavg", lambda: (22.0, 3.0, 1.0))
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    assert load_now() == Load(22.0, 2)


def test_where_the_system_does_not_tell_nothing_is_known(monkeypatch):
    monkeypatch.delattr(os, "getloadavg")
    assert load_now() is None
