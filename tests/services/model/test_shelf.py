"""A robot's skills are files that are called as it calls them; none is lost, half there, or moved while it is used."""

import os
import signal
import sqlite3
import subprocess
import sys

import numpy as np
import pytest

from lfd.exceptions import StorageError
from lfd.motion.demonstration import Demonstration
from lfd.motion.provenance import Provenance
from lfd.motion.trajectory import Trajectory
from lfd.store.stored import About, Binding, Counts, Purpose
from services.model.exceptions import NoSuchSkill, SkillMisfit, SkillNameBad, SkillOpen, SkillThere
from services.model.shelf import Shelf

TABLE, ON_PANDA = Binding("table", "tiago"), Binding("table", "panda")


def demonstration(y=0.1, author=""):
    path = np.linspace((0.5, 0.0, 0.5), (0.8, y, 0.6), 10)
    motion = Trajectory(path, np.tile((1.0, 0.0, 0.0, 0.0), (10, 1)), 5.0)
    return Demonstration.reaching(motion, path[-1], Provenance(author))


@pytest.fixture
def shelf(tmp_path):
    return Shelf(tmp_path / "robot1", "robot1")


@pytest.fixture
def cups(shelf):
    """A skill of this name with two demonstrations, one of them taken back."""
    shelf.new("cups", About(TABLE, "anna", "the blue ones", 1.0))
    with shelf.read("cups") as store:
        for y in (0.1, 0.2):
            store.add(demonstration(y), Purpose.INITIAL, TABLE)
        store.undo(2)
    return "cups"


def held(shelf, name):
    with shelf.read(name) as store:
        return store.whole()


def test_a_new_skill_is_empty_and_says_what_it_is_for(shelf):
    shelf.new("cups", About(TABLE, "anna", "the blue ones", 1.0))
    (found,) = shelf.all()
    assert (found.name, found.version, found.about) == ("cups", 0, About(TABLE, "anna", "the blue ones", 1.0))


def test_what_is_listed_has_its_figures(shelf, cups):
    found = shelf.find(cups)
    assert (found.version, found.counts, found.fault) == (3, Counts(1, 0), "")


@pytest.mark.parametrize("name", ["", ".hidden", "-flag", "a/b", "..", "ümlaut", "a b", "a" * 65, "a\n"])
def test_what_is_no_name_is_refused(shelf, name):
    with pytest.raises(SkillNameBad, match="1 to 64"):
        shelf.new(name, About(TABLE))
    assert shelf.names() == []


@pytest.mark.parametrize("name", ["cups", "Cups", "CUPS"])
def test_a_name_that_is_taken_in_whichever_capitals_is_refused_and_nothing_changes(shelf, cups, name):
    before = held(shelf, cups)
    shelf.new("plates", About(TABLE))
    for make in (lambda: shelf.new(name, About(TABLE)), lambda: shelf.copy("plates", name)):
        with pytest.raises(SkillThere, match="choose another name"):
            make()
    with pytest.raises(SkillThere):
        shelf.rename("plates", name)
    assert (shelf.names(), held(shelf, cups)) == (["cups", "plates"], before)


def test_a_skill_renamed_there_and_back_is_as_it_was_and_may_change_its_capitals(shelf, cups):
    before = held(shelf, cups)
    shelf.rename(cups, "Cups")
    assert shelf.names() == ["Cups"]
    shelf.rename("Cups", cups)
    assert held(shelf, cups) == before


def test_a_copy_is_the_same_and_goes_its_own_way(shelf, cups):
    before = held(shelf, cups)
    shelf.copy(cups, "glasses")
    assert held(shelf, "glasses") == before
    with shelf.read("glasses") as store:
        store.add(demonstration(), Purpose.UPDATE, TABLE)
    assert held(shelf, cups) == before


def test_what_was_dropped_twice_comes_back_the_last_one_first(shelf, cups):
    before = held(shelf, cups)
    shelf.drop(cups)
    assert (shelf.names(), shelf.dropped()) == ([], ["cups"])
    shelf.new(cups, About(TABLE, notes="another one"))
    shelf.drop(cups)
    shelf.bring_back(cups)
    assert shelf.find(cups).about.notes == "another one"
    with pytest.raises(SkillThere):
        shelf.bring_back(cups)
    shelf.rename(cups, "another")
    shelf.bring_back(cups)
    assert held(shelf, cups) == before
    assert shelf.dropped() == []
    with pytest.raises(NoSuchSkill):
        shelf.bring_back(cups)


def test_what_a_process_has_open_is_neither_moved_nor_dropped_but_copied_and_read(shelf, cups):
    store = shelf.take(cups, TABLE, 5.0)
    for change in (lambda: shelf.rename(cups, "glasses"), lambda: shelf.drop(cups)):
        with pytest.raises(SkillOpen, match=r"the model process of robot 'robot1' has skill 'cups' open"):
            change()
    with pytest.raises(SkillOpen), shelf.only(cups):
        pass
    shelf.copy(cups, "glasses")
    assert held(shelf, "glasses") == held(shelf, cups)
    assert shelf.find(cups).about.used_s == 5.0
    store.add(demonstration(), Purpose.UPDATE, TABLE)
    store.close()
    shelf.drop(cups)


def test_what_was_learnt_for_something_else_is_not_taken_and_stays(shelf, cups):
    before = held(shelf, cups)
    said = r"^skill 'cups' is for task table on tiago; this robot is panda in table: choose another skill$"
    with pytest.raises(SkillMisfit, match=said):
        shelf.take(cups, ON_PANDA, 5.0)
    assert held(shelf, cups) == before
    assert "for task table on tiago" in shelf.find(cups).misfit(ON_PANDA)
    assert shelf.find(cups).misfit(TABLE) == ""


def test_a_damaged_file_is_listed_with_its_fault_and_another_programs_is_not(shelf, cups):
    shelf.path("broken").write_bytes(b"not a database, whatever its name says" * 100)
    with sqlite3.connect(shelf.path("bookmarks")) as other:
        other.execute("CREATE TABLE bookmarks (address)")
    other.close()
    found = {skill.name: skill for skill in shelf.all()}
    assert set(found) == {"broken", cups}
    assert "restore it from a copy" in found["broken"].misfit(TABLE)
    with pytest.raises(NoSuchSkill):
        shelf.find("bookmarks")


def test_a_name_that_is_nearly_right_is_asked_back(shelf, cups):
    with pytest.raises(NoSuchSkill, match=r"did you mean cups\?"):
        shelf.read("cubs")


def test_what_cannot_be_filled_leaves_nothing(shelf):
    def fill(store):
        store.describe(About(TABLE))
        raise StorageError(shelf.path("cups"), "the power went", "try again")

    with pytest.raises(StorageError):
        shelf.put("cups", fill)
    assert (shelf.names(), [file.name for file in shelf.folder.iterdir()]) == ([], [".skills.lock"])


_KILLED = """
import os, signal, sys
from pathlib import Path
from lfd.store.stored import About, Binding
from services.model.shelf import Shelf

def fill(store):
    store.describe(About(Binding("table", "tiago")))
    os.kill(os.getpid(), signal.SIGKILL)

Shelf(Path(sys.argv[1]), "robot1").put("cups", fill)
"""


def test_who_is_killed_while_a_skill_is_made_leaves_none_and_the_next_one_sweeps_up(shelf):
    killed = subprocess.run([sys.executable, "-c", _KILLED, str(shelf.folder)], check=False, env={**os.environ})
    assert killed.returncode == -signal.SIGKILL
    assert shelf.names() == []
    shelf.new("cups", About(TABLE))
    assert sorted(file.name for file in shelf.folder.iterdir()) == [".skills.lock", "cups.sqlite"]


def test_a_file_of_todays_schema_is_taken_over_in_place_as_a_skill_of_its_scene(shelf, cups):
    """As the version before this one wrote it."""
    before = held(shelf, cups)
    shelf.rename(cups, "table")
    with sqlite3.connect(shelf.path("table")) as old:
        old.execute("DROP TABLE skill")
        old.execute("PRAGMA user_version = 6")
    old.close()
    store = shelf.take("table", TABLE, 5.0)
    assert store.whole()[1:] == before[1:]
    assert store.about().binding == TABLE
    store.close()
    assert (shelf.folder / "table.sqlite.schema-6").is_file()
    assert shelf.names() == ["table"]


_RENAMES = """
import sys
from pathlib import Path
from services.model.exceptions import SkillOpen
from services.model.shelf import Shelf

try:
    Shelf(Path(sys.argv[1]), "robot1").rename("cups", "mugs")
except SkillOpen:
    sys.exit(7)
"""


def test_whoever_lists_the_skills_keeps_the_one_that_it_has_open(shelf, cups):
    """A process that closes a file it has opened beside SQLite gives up all of its locks on it."""
    store = shelf.take(cups, TABLE, 5.0)
    shelf.all()
    tried = subprocess.run([sys.executable, "-c", _RENAMES, str(shelf.folder)], check=False, env={**os.environ})
    assert (tried.returncode, shelf.names()) == (7, [cups])
    store.close()
