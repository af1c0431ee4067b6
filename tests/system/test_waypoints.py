"""A person writes waypoints down; the running model learns the motion through them."""

import numpy as np
import pytest

from protocol import queries
from protocol.messages import Pose
from services.bus.arrays import motion_from_wire
from tests.system.harness import Command, Witness, configured

pytestmark = [pytest.mark.system, pytest.mark.zenoh]

WITHIN_S = 60.0
OBJECT = (0.85, 0.05, 0.55)
START = Pose((0.5, 0.0, 0.4), (1.0, 0.0, 0.0, 0.0))


def written(folder, height):
    """A file of a motion to the object that passes the middle at a height [m]."""
    rows = ["x,y,z,qw,qx,qy,qz", "0.5,0,0.4,1,0,0,0", f"0.7,0.05,{height},1,0,0,0", "0.85,0.05,0.55,0.8,0,0.6,0"]
    path = folder / "reach.csv"
    path.write_text("\n".join(rows))
    return path


def test_a_motion_through_waypoints_is_learnt_first_and_then_as_an_update(tmp_path, router):
    configuration = configured(tmp_path, router, model=f'database = "{tmp_path / "model.sqlite"}"')
    place = ",".join(map(str, OBJECT))
    with Command("model", "--config", configuration, folder=tmp_path), Witness(router) as witness:
        witness.asked(queries.DESCRIBE, queries.Describe(), WITHIN_S)
        for height, demonstrations, updates in ((0.5, 1, 0), (0.7, 1, 1)):
            flags = ("--waypoints", written(tmp_path, height), "--object", place, "--duration", "8")
            with Command("teach", *flags, "--config", configuration, folder=tmp_path) as teach:
                assert teach.ended(WITHIN_S) == 0, teach.tail()
            assert "through 3 waypoints" in teach.err
            state = witness.asked(queries.DESCRIBE, queries.Describe()).state
            assert (state.demonstrations, state.updates) == (demonstrations, updates)
            predicted = witness.asked(queries.PREDICT, queries.Predict(OBJECT, START)).prediction
            positions, orientations, duration, _ = motion_from_wire(predicted.motion)
            np.testing.assert_allclose(positions[37], (0.7, 0.05, height), atol=0.01)
            np.testing.assert_allclose(positions[-1], OBJECT, atol=0.005)
            np.testing.assert_allclose(np.abs(orientations[-1]), (0.8, 0.0, 0.6, 0.0), atol=0.02)
            assert duration == pytest.approx(8.0, rel=0.01)
