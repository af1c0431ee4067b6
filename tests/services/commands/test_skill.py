"""`retouch skill`: each word does what it says, on the files, and in one line where it does not."""

from contextlib import contextmanager

import numpy as np
import pytest

from lfd.motion.demonstration import Demonstration
from lfd.motion.provenance import Provenance
from lfd.motion.trajectory import Trajectory
from lfd.store.stored import Binding, Purpose
from protocol.messages import ModelState
from protocol.queries import CHOOSE_SKILL, DESCRIBE, UNDO, ChooseSkill, Learnt
from services.cli import main
from services.commands.skill import changing
from services.model.shelf import Shelf
from services.process.exceptions import RouterUnreachable

TABLE = Binding("table", "tiago")


@pytest.fixture
def shelf(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setenv("COLUMNS", "160")
    monkeypatch.chdir(tmp_path)
    return Shelf(tmp_path / "data" / "retouch" / "robot1", "robot1")


@pytest.fixture
def retouch(capsys):
    """Runs a command: its exit code, and the lines that it said."""

    def run(*words):
        code = main(["skill", *words])
        said = capsys.readouterr()
        return code, (said.out + said.err).splitlines()

    return run


@pytest.fixture
def cups(shelf, retouch):
    retouch("new", "cups", "--task", "table", "--notes", "the blue ones", "--operator", "anna")
    path = np.linspace((0.5, 0.0, 0.5), (0.8, 0.1, 0.6), 10)
    motion = Trajectory(path, np.tile((1.0, 0.0, 0.0, 0.0), (10, 1)), 5.0)
    with shelf.read("cups") as store:
        for purpose in (Purpose.INITIAL, Purpose.UPDATE):
            store.add(Demonstration.reaching(motion, path[-1], Provenance("ben", 1.5e9)), purpose, TABLE)
    return "cups"


def test_the_list_has_a_line_for_each_with_its_task_robot_and_what_it_has_learnt(cups, retouch):
    retouch("new", "plates", "--robot-model", "panda")
    code, lines = retouch("list")
    assert code == 0
    assert lines[1].split() == ["cups", "table", "tiago", "2", "1", "1", "never", "anna", "the", "blue", "ones"]
    assert lines[2].split()[:3] == ["plates", "dishwasher", "panda"]


def test_where_there_is_none_the_list_says_how_to_make_one(shelf, retouch):
    assert "retouch skill new" in retouch("list")[1][0]


def test_a_skill_is_shown_with_its_figures_and_its_entries(cups, retouch):
    retouch("undo", cups)
    code, lines = retouch("show", cups)
    text = "\n".join(lines)
    assert code == 0
    for said in ("task table on tiago", "by anna", "used last never", "the blue ones", "version 3"):
        assert said in text
    assert "1 demonstration, 0 corrections, 1 taken back" in text
    assert [line.split()[0] for line in lines if "ben" in line] == ["2", "1"]


def test_renamed_copied_dropped_and_undone(cups, retouch, shelf):
    assert retouch("copy", cups, "glasses")[0] == retouch("rename", cups, "mugs")[0] == 0
    assert shelf.names() == ["glasses", "mugs"]
    code, (line,) = retouch("drop", "mugs")
    assert (code, shelf.names()) == (2, ["glasses", "mugs"])
    assert "--yes" in line
    assert retouch("drop", "mugs", "--yes")[0] == 0
    assert "dropped: mugs" in retouch("list")[1][-1]
    assert retouch("undo", "mugs")[0] == 0
    assert shelf.names() == ["glasses", "mugs"]


def test_undo_takes_back_the_newest_correction_then_the_demonstration_then_nothing(cups, retouch):
    assert [retouch("undo", cups)[1][0].split()[3] for _ in range(2)] == ["2", "1"]
    code, (line,) = retouch("undo", cups)
    assert code == 2
    assert "nothing to take back" in line


def test_any_entry_is_taken_back_and_one_that_is_not_there_is_named(cups, retouch):
    assert retouch("undo", cups, "--entry", "1")[0] == 0
    for entry in ("1", "7"):
        code, (line,) = retouch("undo", cups, "--entry", entry)
        assert code == 2
        assert entry in line


def test_notes_are_written_anew(cups, retouch, shelf):
    assert retouch("note", cups, "the red ones")[0] == 0
    assert shelf.find(cups).about.notes == "the red ones"
    code, (line,) = retouch("note", cups, "x" * 1001)
    assert code == 2
    assert "1000" in line


def test_exported_and_imported_under_another_name(cups, retouch, shelf):
    assert retouch("export", cups)[0] == 0
    code, (line,) = retouch("export", cups)
    assert code == 2
    assert "is there already" in line
    assert retouch("import", "cups.retouch-skill", "--name", "cups-of-anna")[0] == 0
    with shelf.read(cups) as one, shelf.read("cups-of-anna") as other:
        assert one.whole() == other.whole()


@pytest.mark.parametrize(
    "words",
    [
        ("show", "nix"),
        ("undo", "nix"),
        ("drop", "nix", "--yes"),
        ("export", "nix"),
        ("note", "nix", "text"),
        ("rename", "nix", "nax"),
        ("rename", "cups", "../cups"),
        ("copy", "cups", "Cups"),
        ("new", "cups"),
        ("new", "plates", "--task", "nowhere"),
        ("import", "nix.retouch-skill"),
    ],
)
def test_what_cannot_be_done_is_one_line_and_changes_nothing(cups, retouch, shelf, words):
    before = [(skill.name, skill.version, skill.about) for skill in shelf.all()]
    code, lines = retouch(*words)
    assert code == 2
    assert len(lines) == 1
    assert [(skill.name, skill.version, skill.about) for skill in shelf.all()] == before


@pytest.mark.parametrize("words", [("rename", "cups", "mugs"), ("drop", "cups", "--yes")])
def test_what_the_model_process_has_open_stays_and_the_machine_is_named_as_the_cause(cups, retouch, shelf, words):
    store = shelf.take(cups, TABLE, 5.0)
    code, (line,) = retouch(*words)
    assert code == 3
    assert "the model process of robot 'robot1' has skill 'cups' open" in line
    store.close()


class Model:
    """Stands for the running model process: keeps what it was asked."""

    def __init__(self):
        self.asked = []

    def state(self):
        return ModelState(kind="adaptive", version=2, demonstrations=1, updates=1, scene="table", skill="cups")

    def ask(self, query, request, what):
        self.asked.append((query, request))
        assert what
        return Learnt(self.state(), 2)


@pytest.fixture
def model(monkeypatch):
    model = Model()

    @contextmanager
    def connected(settings, command):
        assert command in {asker for query in (UNDO, CHOOSE_SKILL, DESCRIBE) for asker in query.askers}
        yield model

    monkeypatch.setattr(changing, "model_process", connected)
    return model


def test_what_is_open_is_undone_by_the_process_that_has_it_by_its_name(cups, retouch, shelf, model):
    with shelf.take(cups, TABLE, 5.0):
        code, (line,) = retouch("undo", cups, "--operator", "anna")
    ((query, request),) = model.asked
    assert (code, query, request.skill, request.operator) == (0, UNDO, "cups", "anna")
    assert request.request
    assert "entry 2" in line


def test_another_skill_is_used_by_asking_the_model_process(cups, retouch, model):
    assert retouch("use", cups, "--operator", "anna")[0] == 0
    ((query, request),) = model.asked
    assert (query, request) == (CHOOSE_SKILL, ChooseSkill("cups", operator="anna", request=request.request))


def test_where_what_is_open_cannot_be_asked_for_it_says_who_has_it(cups, retouch, shelf, monkeypatch):
    def unreachable(settings, command):
        raise RouterUnreachable(settings.connect, 1.0, "nobody there")

    monkeypatch.setattr(changing, "model_process", unreachable)
    with shelf.take(cups, TABLE, 5.0):
        code, (line,) = retouch("undo", cups)
    assert code == 3
    assert "has skill 'cups' open" in line
