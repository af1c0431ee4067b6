"""Each task's skill lies by itself, and what an earlier version put elsewhere is found again."""

import numpy as np
import pytest

from lfd.exceptions import BoundElsewhere
from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from lfd.store.database import DemonstrationStore
from lfd.store.stored import Binding, Purpose
from services.model.history import History
from services.model.learning import MODELS
from services.model.skill import binding_of
from services.model.skills import Skills
from services.process.config import ModelSection
from services.process.exceptions import EnvironmentFault
from sim.tasks import DISHWASHER, PARTICLE, TABLE

SECTION = ModelSection()


@pytest.fixture
def data(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    return tmp_path / "retouch"


def opened(section, robot, binding):
    return Skills(section, robot, binding, lambda store: History(store, binding, "adaptive", MODELS), lambda: 7.0)


def demonstration():
    path = np.linspace((0.5, 0.0, 0.5), (0.8, 0.1, 0.6), 10)
    motion = Trajectory(path, np.tile((1.0, 0.0, 0.0, 0.0), (10, 1)), 5.0)
    return Demonstration.reaching(motion, path[-1])


def held(robot, binding, section=SECTION):
    skills = opened(section, robot, binding)
    skills.close()
    return skills.name, len(skills.history.in_use)


def teach(robot, binding):
    skills = opened(SECTION, robot, binding)
    skills.history.add(demonstration(), Purpose.INITIAL, 0)
    skills.close()


@pytest.mark.parametrize("other", [("robot1", TABLE), ("robot2", DISHWASHER), ("robot1", PARTICLE)])
def test_each_robot_and_task_has_a_skill_of_its_own_called_as_the_task(data, other):
    teach("robot1", binding_of(DISHWASHER))
    robot, scene = other
    assert held(robot, binding_of(scene)) == (scene.name, 0)
    assert held("robot1", binding_of(DISHWASHER)) == ("dishwasher", 1)


def test_another_kind_of_robot_has_one_beside_it(data):
    teach("robot1", Binding("table", "tiago"))
    assert held("robot1", Binding("table", "panda")) == ("table-panda", 0)


def test_what_an_earlier_version_kept_for_a_robot_is_found_by_its_task_only(data):
    (data / "robot1").mkdir(parents=True)
    with DemonstrationStore(data / "robot1" / "model.sqlite") as store:
        store.add(demonstration(), Purpose.INITIAL, binding_of(TABLE))
    assert held("robot1", binding_of(TABLE)) == ("model", 1)
    assert held("robot1", binding_of(DISHWASHER)) == ("dishwasher", 0)


def test_a_file_that_is_bound_by_what_it_holds_is_taken_for_nothing_else(data):
    (data / "robot1").mkdir(parents=True)
    with DemonstrationStore(data / "robot1" / "dishwasher.sqlite") as store:
        store.add(demonstration(), Purpose.INITIAL, binding_of(TABLE))
    with pytest.raises(BoundElsewhere):
        opened(SECTION, "robot1", binding_of(DISHWASHER))


def test_a_configured_file_is_made_with_its_folder(tmp_path):
    path = tmp_path / "of" / "mine" / "cups.sqlite"
    assert held("robot1", Binding("table", "tiago"), ModelSection(database=str(path))) == ("cups", 0)
    assert path.is_file()


def test_a_configured_folder_that_cannot_be_made_is_named_in_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    section = ModelSection(database=str(tmp_path / "file" / "cups.sqlite"))
    with pytest.raises(EnvironmentFault, match="file") as caught:
        opened(section, "robot1", Binding("table", "tiago"))
    assert "\n" not in str(caught.value)
