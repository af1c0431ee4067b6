"""What is drawn is drawn live and in the file; who listens where."""

import socket

import msgspec
import numpy as np
import pytest

from services.process.exceptions import PortInUse

pytestmark = pytest.mark.sim


@pytest.fixture
def recording(configuration):
    from services.viewer.run import Run
    from sim.tasks.scene import Eye

    recording = Run(configuration.viewer, "testbed", 0, Eye())
    yield recording
    recording.close()


def rows(path, entity):
    from rerun.chunk import RrdReader

    return [c.to_record_batch().to_pydict() for c in RrdReader(str(path)).stream() if c.entity_path == entity]


def test_the_stream_is_served_at_its_port(recording, configuration):
    socket.create_connection(("127.0.0.1", configuration.viewer.stream_port), timeout=5).close()


def test_a_stream_port_in_use_is_named_with_its_setting_and_no_file_is_begun(configuration, tmp_path):
    from services.viewer.run import Run
    from sim.tasks.scene import Eye

    with (
        socket.create_server(("127.0.0.1", configuration.viewer.stream_port)),
        pytest.raises(PortInUse, match="stream_port"),
    ):
        Run(configuration.viewer, "testbed", 0, Eye())
    assert not (tmp_path / "runs").exists()


def test_what_stands_is_on_the_files_time_line_each_time(recording):
    import rerun as rr

    for second in range(3):
        recording.at(second * 1_000_000_000)
        recording.stand("/box", rr.Scalars([1.0]), value=1.0)
    recording.close()
    (batch,) = rows(recording.parts.path, "/box")
    assert len(batch["time"]) == 3


@pytest.mark.parametrize(
    ("host", "origins"),
    [
        ("127.0.0.1", ["http://127.0.0.1:9090", "http://[::1]:9090", "http://localhost:9090"]),
        ("0.0.0.0", ["http://*:9090"]),
    ],
)
def test_the_stream_is_read_by_the_viewers_own_page_only(configuration, host, origins):
    from services.viewer.live import page_origins

    assert page_origins(msgspec.structs.replace(configuration.viewer, host=host, web_port=9090)) == origins


def test_the_correction_is_shown_in_millimetres_and_degrees(recording):
    from services.viewer import entities, series

    recording.at(0)
    series.log_correction(recording, (0.05, 0.0, -0.01), (0.0, np.pi / 6, 0.0))
    recording.close()
    shown = {name: rows(recording.parts.path, f"{entities.CORRECTION}/{name}") for name in ("offset", "turn")}
    (offset,), (turn,) = ([b["Scalars:scalars"] for b in batches if "time" in b] for batches in shown.values())
    np.testing.assert_allclose(offset, [[50.0, 0.0, -10.0]])
    np.testing.assert_allclose(turn, [[0.0, 30.0, 0.0]])
