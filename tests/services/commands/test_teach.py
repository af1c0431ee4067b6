"""`retouch teach`: what a person can have got wrong is one line before anything is asked of the network."""

import threading

import pytest

from protocol import queries
from services.bus.memory import MemoryNetwork
from services.cli import main, parser
from services.commands.model_process import ModelProcess
from services.process.clock import ManualClock
from services.process.exceptions import EnvironmentFault, NoAnswer


@pytest.mark.parametrize("text", ["0.8,-0.1,0.5", " 0.8, -0.1, 5e-1"])
def test_the_object_is_three_numbers(text):
    assert parser().parse_args(["teach", "--object", text]).object == (0.8, -0.1, 0.5)


@pytest.mark.parametrize(
    ("flag", "text"),
    [
        *(("--object", text) for text in ("", "0.8", "0.8,0.1", "0.8,0.1,0.5,1", "0.8,here,0.5", "0.8,nan,0.5")),
        *(("--duration", text) for text in ("0", "nan", "inf", "3601", "long")),
    ],
)
def test_an_object_or_duration_that_is_none_is_named(capsys, flag, text):
    with pytest.raises(SystemExit) as caught:
        parser().parse_args(["teach", flag, text])
    (line,) = capsys.readouterr().err.splitlines()
    assert caught.value.code == 2
    assert flag in line
    assert repr(text) in line


WAYPOINTS = ("x,y,z,qw,qx,qy,qz", "0.5,0,0.4,1,0,0,0", "0.7,0.05,0.5,1,0,0,0", "0.85,0.05,0.55,1,0,0,0")


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "reach.csv"
    path.write_text("\n".join(WAYPOINTS))
    return str(path)


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        (("--object", "850,50,550"), ("(850.000, 50.000, 550.000)", "dishwasher", "(0.780, -0.130, 0.503)")),
        (
            ("--object", "0.85,0.05,0.55", "--scene", "particle"),
            ("particle has no object", "table or post"),
        ),
        (("--object", "0.65,0.24,0.71", "--scene", "table"), ("reach.csv", "line 4", "away from the object")),
    ],
)
def test_what_does_not_fit_the_scene_is_one_line(capsys, file, flags, said):
    assert main(["teach", "--waypoints", file, *flags]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    for words in said:
        assert words in line


def test_taking_back_and_teaching_are_not_one_command(capsys, file):
    assert main(["teach", "--undo", "--waypoints", file]) == 2
    assert "--undo" in capsys.readouterr().err


@pytest.fixture
def network():
    return MemoryNetwork(ManualClock())


def asked(network, stop):
    return ModelProcess(network.bus("teach"), network.robot, network.clock, stop).state()


def test_a_model_that_is_not_there_is_the_networks_fault_and_no_wrong_input(network):
    with pytest.raises(NoAnswer, match="the model of robot 'robot1' did not answer in 10 s: nobody answers") as caught:
        asked(network, threading.Event())
    assert isinstance(caught.value, EnvironmentFault)
    assert caught.value.passes, "where `retouch up` teaches, a model that comes later is taught later"


def test_whoever_ends_the_waiting_for_an_answer_has_interrupted_it(network):
    network.bus("model").serve(queries.DESCRIBE)
    stop = threading.Event()
    stop.set()
    with pytest.raises(KeyboardInterrupt):
        asked(network, stop)
