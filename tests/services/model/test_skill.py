"""Each scene's demonstrations lie by themselves, and those that an earlier version put elsewhere are found again."""

import numpy as np
import pytest

from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from lfd.store.database import DemonstrationStore
from lfd.store.stored import Binding, Purpose
from services.model.skill import binding_of, open_store
from services.process.config import ModelSection
from services.process.exceptions import EnvironmentFault
from sim.tasks import DISHWASHER, PARTICLE, TABLE

SECTION = ModelSection()


@pytest.fixture
def data(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    return tmp_path / "retouch"


def taught(store, scene):
    path = np.linspace((0.5, 0.0, 0.5), (0.8, 0.1, 0.6), 10)
    motion = Trajectory(path, np.tile((1.0, 0.0, 0.0, 0.0), (10, 1)), 5.0)
    store.add(Demonstration.reaching(motion, path[-1]), Purpose.INITIAL, binding_of(scene))


@pytest.mark.parametrize("other", [("robot1", TABLE), ("robot2", DISHWASHER), ("robot1", PARTICLE)])
def test_each_robot_and_scene_has_a_file_of_its_own(data, other):
    with open_store(SECTION, "robot1", binding_of(DISHWASHER)) as store:
        taught(store, DISHWASHER)
    robot, scene = other
    with open_store(SECTION, robot, binding_of(scene)) as store:
        assert store.active() == []
    with open_store(SECTION, "robot1", binding_of(DISHWASHER)) as store:
        assert len(store.active()) == 1


def test_what_an_earlier_version_kept_for_a_robot_is_found_by_its_scene_only(data):
    (data / "robot1").mkdir(parents=True)
    with DemonstrationStore(data / "robot1" / "model.sqlite") as store:
        taught(store, TABLE)
    with open_store(SECTION, "robot1", binding_of(TABLE)) as store:
        assert len(store.active()) == 1
    with open_store(SECTION, "robot1", binding_of(DISHWASHER)) as store:
        assert store.active() == []


def test_a_configured_file_is_made_with_its_folder(tmp_path):
    path = tmp_path / "of" / "mine" / "skill.sqlite"
    open_store(ModelSection(database=str(path)), "robot1", Binding("table", "tiago")).close()
    assert path.is_file()


def test_a_configured_folder_that_cannot_be_made_is_named_in_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(EnvironmentFault, match="file") as caught:
        open_store(ModelSection(database=str(tmp_path / "file" / "skill.sqlite")), "robot1", Binding("table", "tiago"))
    assert "\n" not in str(caught.value)
