"""A viewer that is stepped by hand: free ports, a folder of its own, a web viewer's files that weigh nothing."""

import gzip

import msgspec
import pytest

from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.process.config import Configuration, RobotSection, ViewerSection
from tests.ports import free_port


@pytest.fixture
def configuration(tmp_path):
    section = ViewerSection(web_port=free_port(), stream_port=free_port(), folder=str(tmp_path / "runs"))
    return Configuration(name="testbed", viewer=section)


@pytest.fixture
def files(tmp_path):
    folder = tmp_path / "web"
    folder.mkdir()
    for name in ("re_viewer.js", "re_viewer_bg.wasm"):
        (folder / f"{name}.gz").write_bytes(gzip.compress(name.encode()))
    return folder


@pytest.fixture
def build(configuration, files, monkeypatch):
    """A function that starts a viewer for a scene; returns network, clock and viewer."""
    from services.viewer import service

    monkeypatch.setattr(service, "web_files", lambda: files)
    started = []

    def build_(scene):
        clock = ManualClock()
        network = MemoryNetwork(clock)
        configured = msgspec.structs.replace(configuration, robot=RobotSection(scene=scene))
        started.append(service.build(network.bus(), clock, configured))
        return network, clock, started[-1]

    yield build_
    for viewer in started:
        viewer.close()


@pytest.fixture
def system(build):
    return build("dishwasher")
