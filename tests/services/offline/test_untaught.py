"""An empty skill and a scripted operator: it is shown at two places, seen alone, kept, and the loop closes."""

import msgspec
import numpy as np
import pytest

from protocol.messages import Method, Mode
from protocol.topics import TEACHING_STATE
from services.offline.rehearsal import Plan
from services.offline.stage import Stage

TRIES = 3


def taught(folder, robot, scene, method):
    """How it ended, of a robot in a scene."""
    configuration = Plan(scene, "adaptive", (), ()).configuration(folder / "model.sqlite")
    station = msgspec.structs.replace(configuration.station, untaught=True, method=method)
    stands = msgspec.structs.replace(configuration.robot, model=robot)
    stage = Stage(msgspec.structs.replace(configuration, station=station, robot=stands))
    told = stage.bus().subscribe(TEACHING_STATE)
    try:
        stage.teach(None, TRIES, lambda: told.latest() is not None and told.latest().message.finished)
    finally:
        stage.close()
    return told.latest().message


@pytest.mark.sim
@pytest.mark.parametrize(
    ("robot", "scene", "method"),
    [
        ("panda", "pick", Method.WAYPOINTS),
        pytest.param("panda", "pick", Method.DEMONSTRATE, marks=pytest.mark.long),
        pytest.param("tiago", "pick", Method.WAYPOINTS, marks=pytest.mark.long),
        pytest.param("panda", "place", Method.WAYPOINTS, marks=pytest.mark.long),
        pytest.param("ur5", "table", Method.WAYPOINTS, marks=pytest.mark.long),
        pytest.param("panda", "table", Method.WAYPOINTS, marks=pytest.mark.long),
        pytest.param("panda", "table", Method.DEMONSTRATE, marks=pytest.mark.long),
        pytest.param("tiago", "table", Method.DEMONSTRATE, marks=pytest.mark.long),
        pytest.param("tiago", "dishwasher", Method.WAYPOINTS, marks=pytest.mark.long),
    ],
)
def test_a_script_shows_an_empty_skill_two_places_and_the_loop_closes(tmp_path, robot, scene, method):
    ended = taught(tmp_path, robot, scene, method)
    assert ended.loop_closed, ended.reason
    shown = [one for one in ended.attempts if one.mode is Mode.TEACH and one.verdict.success]
    first, last = (np.array(one.object_position) for one in (shown[0], shown[-1]))
    assert np.linalg.norm(first - last) > 0.05
    assert (ended.attempts[-1].mode, ended.attempts[-1].operator_input) == (Mode.AUTONOMOUS, False)
