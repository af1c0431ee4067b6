"""The first demonstrations are taught once, and kept wherever there is a place."""

import sys
from pathlib import Path

import numpy as np
import pytest

from lfd.exceptions import StorageUnavailable
from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from services.offline import first_demonstrations as module
from services.offline.first_demonstrations import first_demonstrations
from sim import tasks
from sim.tasks import SCENES
from sim.tasks.task_file import load_task

SCENE = next(iter(SCENES.values()))


@pytest.fixture
def teaching(monkeypatch):
    """The scenes that were taught, in place of the simulator."""
    import services.offline

    taught = []

    class Demonstrations:
        @staticmethod
        def demonstrations(scene):
            taught.append(scene.name)
            motion = Trajectory(np.eye(3), np.tile((1.0, 0.0, 0.0, 0.0), (3, 1)), 10.0)
            return [Demonstration.reaching(motion, np.array((0.8, 0.0, 0.5)))]

    monkeypatch.setitem(sys.modules, "services.offline.demonstrations", Demonstrations)
    monkeypatch.setattr(services.offline, "demonstrations", Demonstrations, raising=False)
    return taught


def test_they_are_taught_at_first_use_and_kept(tmp_path, teaching):
    first = first_demonstrations(SCENE, tmp_path)
    assert len(first) == 1
    np.testing.assert_array_equal(
        first_demonstrations(SCENE, tmp_path)[0].trajectory.positions, first[0].trajectory.positions
    )
    assert teaching == [SCENE.name]


def test_a_full_disk_costs_no_second_lesson(tmp_path, monkeypatch, teaching):
    full = tmp_path / "full"

    class Store(module.DemonstrationStore):
        def __init__(self, path):
            if full in Path(path).parents:
                raise StorageUnavailable(path, "the disk is full", "make room on it", passes=False)
            super().__init__(path)

    (tmp_path / "tmp").mkdir()
    monkeypatch.setattr(module, "DemonstrationStore", Store)
    monkeypatch.setenv("XDG_CACHE_HOME", str(full))
    monkeypatch.setattr("sim.cache.tempfile.gettempdir", lambda: str(tmp_path / "tmp"))
    assert len(first_demonstrations(SCENE)) == 1
    assert teaching == [SCENE.name]


def test_another_text_of_a_persons_task_is_taught_anew(tmp_path, teaching):
    file = tmp_path / "mine.toml"
    text = Path(str(tasks.__file__)).with_name("table.toml").read_text().replace('name = "table"', 'name = "mine"')
    for reached in ("0.05", "0.04", "0.04"):
        file.write_text(text.replace("reached = [0.05", f"reached = [{reached}"))
        first_demonstrations(load_task(file), tmp_path / "cache")
    assert teaching == ["mine", "mine"]
