"""What is drawn is drawn live and in the file; who listens where."""

import shutil
import socket

import msgspec
import pytest

from services.process.exceptions import PortInUse
from tests.services.viewer.read import Read

pytestmark = pytest.mark.sim


@pytest.fixture
def recording(configuration):
    from services.viewer.run import Run
    from sim.tasks.scene import Eye

    recording = Run(configuration.viewer, "testbed", 0, Eye(), ("head",))
    yield recording
    recording.close()


def test_the_stream_is_served_at_its_port(recording, configuration):
    socket.create_connection(("127.0.0.1", configuration.viewer.stream_port), timeout=5).close()


def test_a_stream_port_in_use_is_named_with_its_setting_and_no_file_is_begun(configuration, tmp_path):
    from services.viewer.run import Run
    from sim.tasks.scene import Eye

    with (
        socket.create_server(("127.0.0.1", configuration.viewer.stream_port)),
        pytest.raises(PortInUse, match="stream_port"),
    ):
        Run(configuration.viewer, "testbed", 0, Eye(), ("head",))
    assert not (tmp_path / "runs").exists()


def test_what_stands_is_on_the_files_time_line_each_time(recording):
    import rerun as rr

    for second in range(3):
        recording.at(second * 1_000_000_000)
        recording.stand("/box", rr.Scalars([1.0]), value=1.0)
    recording.close()
    assert Read(recording.parts.path).moving("/box") == [3]


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


def test_a_run_that_is_killed_loses_no_more_than_a_second_of_rows(recording, tmp_path):
    from services.viewer.kinds import SCALARS

    ticks = 310
    for tick in range(ticks):
        recording.at(round(tick * 1e9 / 30))
        recording.row("/number", SCALARS, [float(tick)])
        recording.send()
    recording.parts.check()
    written = Read(shutil.copy(recording.parts.path, tmp_path / "as_if_killed.rrd")).values("/number")
    assert written == [[float(tick)] for tick in range(len(written))]
    assert ticks - 30 <= len(written) < ticks


def test_a_run_that_is_closed_loses_nothing(recording):
    from services.viewer.kinds import SCALARS

    for tick in range(7):
        recording.at(round(tick * 1e9 / 30))
        recording.row("/number", SCALARS, [float(tick)])
        recording.send()
    recording.close()
    assert Read(recording.parts.path).rows("/number", "Scalars:scalars") == [
        (pytest.approx(tick / 30, abs=1e-9), [float(tick)]) for tick in range(7)
    ]
