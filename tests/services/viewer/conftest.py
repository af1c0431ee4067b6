"""A viewer that is stepped by hand: free ports, a folder of its own, a web viewer's files that weigh nothing."""

import gzip

import msgspec
import pytest

from protocol.topics import RECORDING
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.process.config import Configuration, RobotSection, ViewerSection
from tests.ports import free_port
from tests.services.viewer.read import Read

TICK_S = 1 / 30


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


@pytest.fixture
def record(system):
    """A function that records ticks, each of (topic, message) pairs, and reads the file."""
    network, clock, viewer = system
    bus = network.bus()
    announced = bus.subscribe(RECORDING)

    def record_(*ticks):
        for messages in ticks:
            for topic, message in messages:
                bus.publish(topic, message)
            viewer.step(clock.now_ns())
            clock.advance(TICK_S)
        viewer.close()
        return Read(announced.latest().message.path)

    return record_
