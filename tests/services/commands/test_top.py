"""What `retouch top` shows of heartbeats: the processes, what each measures, and the way from hand to eye."""

import pytest
from rich.console import Console

from protocol.messages import Figure
from protocol.topics import HEARTBEAT
from services.bus.stages import Stages
from services.bus.zenoh import Passing
from services.commands.top import Beats, told
from tests.services.commands.doctor.test_processes import heartbeat, passing

WIDE = 160


@pytest.fixture
def beats():
    """What came from a robot, and from anna's and bob's desks."""
    heard = Beats()
    for process, path in (
        ("robot", Stages(way=0.018, apply=0.006, motion=0.02)),
        ("master-anna", Stages(capture=0.012)),
        ("station-anna", Stages(picture=0.031)),
        ("station-bob", Stages(picture=0.09)),
    ):
        figures = (Figure("simulation_lag", 0.25, "s"), *path.figures())
        heard.receive(passing(heartbeat(process, figures=figures)))
    return heard


def printed(shown):
    console = Console(width=WIDE, file=None, record=True)
    with console.capture() as capture:
        console.print(shown)
    return capture.get()


def test_each_operators_way_from_hand_to_eye_is_a_line(beats):
    anna, bob = (line.plain for line in beats.paths())
    assert anna == (
        "kitchen, anna: from hand to eye 87 ms: capture 12 ms, way 18 ms, apply 6 ms, motion 20 ms, picture 31 ms"
    )
    assert bob.startswith("kitchen, bob: from hand to eye at least 134 ms: capture ?, way 18 ms")


def test_what_the_last_heartbeat_did_not_measure_stays_known_for_a_while(beats):
    beats.receive(passing(heartbeat("master-anna", sequence=2)))
    assert "capture 12 ms" in beats.paths()[0].plain


def test_what_each_process_measures_is_shown(beats):
    said = printed(beats.shown())
    assert "simulation_lag 0.25 s" in said
    assert "stage_motion 20 ms" in said
    assert said.index("master-anna") < said.index("simulation_lag"), "the processes come first"


def test_where_nothing_is_known_yet_that_is_said():
    assert told(Stages()) == ("from hand to eye nothing is known yet (capture ?, way ?, apply ?, motion ?, picture ?)")


def test_a_network_without_operators_has_no_line():
    heard = Beats()
    heard.receive(passing(heartbeat("robot")))
    assert heard.paths() == ()
    printed(heard.shown())


def test_what_is_no_heartbeat_and_what_would_command_the_terminal_is_harmless():
    heard = Beats()
    heard.receive(Passing(HEARTBEAT.key("kitchen", "robot"), b"\xc1", HEARTBEAT.schema))
    heard.receive(passing(heartbeat("robot", figures=(Figure("\x1b[2J[bold]", 1.0, "ms"),))))
    assert "\x1b" not in printed(heard.measured())
