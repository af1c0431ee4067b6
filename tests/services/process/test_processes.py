"""What a process is called on the network: an operator's says whose it is."""

import pytest

from protocol.names import role
from services.process.processes import PROCESSES, process


def test_two_operators_processes_have_two_names_and_a_robot_s_has_one():
    shared = {one.name for one in PROCESSES if one.named("anna") == one.named("bob")}
    assert shared == {"robot", "camera", "perception", "model"}


@pytest.mark.parametrize("one", PROCESSES, ids=lambda one: one.name)
def test_a_process_keeps_its_role_whatever_its_operator_is_called(one):
    assert role(one.named("anna-maria_2")) == one.name


def test_who_gave_no_name_is_not_named():
    assert process("station").named("operator") == "station"
    assert process("station").named("anna") == "station-anna"
