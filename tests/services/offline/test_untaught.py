"""An empty skill and a scripted operator: the first motion is shown by waypoints, learnt, and then done alone."""

import msgspec
import pytest

from protocol.messages import Mode
from protocol.topics import TEACHING_STATE
from services.offline.rehearsal import Plan
from services.offline.result import Arrangement
from services.offline.stage import Stage
from sim.tasks import TABLE

TRIES = 3


@pytest.mark.sim
def test_the_scripted_stylus_teaches_an_empty_skill_by_waypoints_and_the_loop_closes(tmp_path):
    configuration = Plan("table", "adaptive", (), ()).configuration(tmp_path / "model.sqlite")
    station = msgspec.structs.replace(configuration.station, untaught=True)
    stage = Stage(msgspec.structs.replace(configuration, station=station))
    told = stage.bus().subscribe(TEACHING_STATE)
    arrangement = Arrangement(TABLE.variants[-1], tuple(TABLE.training_positions[0].tolist())).reset()
    try:
        stage.teach(arrangement, TRIES, lambda: told.latest() is not None and told.latest().message.finished)
    finally:
        stage.close()
    ended = told.latest().message
    assert ended.loop_closed, ended.reason
    assert ended.updates == 1
    assert [attempt.mode for attempt in ended.attempts[-2:]] == [Mode.TEACH, Mode.AUTONOMOUS]
