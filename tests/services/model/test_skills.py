"""A model process holds all skills of a robot; one is in use, whichever was chosen last, through a restart too."""

import msgspec
import numpy as np
import pytest

from lfd.exceptions import LfdError
from lfd.store.stored import About, Binding
from protocol import queries
from protocol.messages import Purpose
from protocol.queries import ChooseSkill, Learnt, ListSkills, Refused, Undo
from services.bus.memory import MemoryNetwork
from services.model.choice import FILE
from services.model.exceptions import ChoiceLost, NoSuchSkill, SkillMisfit
from services.model.service import build
from services.model.shelf import Shelf
from services.process.clock import ManualClock
from services.process.config import ModelSection
from tests.services.model.rig import Rig, positions

PLATES = Binding("table", "tiago")


def choose(rig, name, **more):
    return rig.ask(queries.CHOOSE_SKILL, ChooseSkill(name, **more))


def listed(rig):
    return rig.ask(queries.SKILLS, ListSkills())


def restarted(rig, **section):
    """Its process was killed, and is there again."""
    model = msgspec.structs.replace(rig.configuration.model, **section)
    rig.configuration = msgspec.structs.replace(rig.configuration, model=model)
    rig.network = MemoryNetwork(ManualClock())
    rig.service = build(rig.network.bus(), rig.clock, rig.configuration)
    rig.asker = rig.network.bus()
    return rig


def test_the_skill_in_use_says_its_name_wherever_it_speaks(rig):
    rig.teach(Purpose.INITIAL)
    assert rig.described().skill == rig.predict().prediction.skill == listed(rig).in_use == "model"


def test_a_new_skill_is_empty_in_use_and_leaves_the_others_as_they_were(rig):
    rig.teach(Purpose.INITIAL)
    before = positions(rig.predict())
    made = choose(rig, "cups", new=True, operator="anna", notes="the blue ones")
    assert (made.state.skill, made.state.version) == ("cups", 0)
    assert isinstance(rig.predict(), Refused)
    cups, model = listed(rig).skills
    assert (cups.author, cups.notes, cups.task, cups.robot_kind) == ("anna", "the blue ones", "dishwasher", "tiago")
    assert (model.demonstrations, model.misfit) == (1, "")
    assert choose(rig, "model").state.demonstrations == 1
    np.testing.assert_array_equal(positions(rig.predict()), before)


def test_what_is_taught_is_learnt_by_the_skill_in_use_alone(rig):
    rig.teach(Purpose.INITIAL)
    choose(rig, "cups", new=True)
    rig.teach(Purpose.INITIAL)
    rig.teach(Purpose.UPDATE, bend=0.1)
    assert choose(rig, "model").state.version == 1
    assert choose(rig, "cups").state.version == 2


def test_what_was_meant_for_another_skill_than_is_in_use_changes_nothing(rig):
    rig.teach(Purpose.INITIAL)
    choose(rig, "cups", new=True)
    assert "meant for skill 'model'" in rig.teach(Purpose.UPDATE, skill="model").reason
    assert "meant for skill 'model'" in rig.ask(queries.UNDO, Undo(entry=1, skill="model")).reason
    assert rig.teach(Purpose.INITIAL, skill="cups").state.version == 1


@pytest.mark.parametrize("killed", [False, True])
def test_what_is_asked_twice_is_done_once_though_another_was_chosen_since(rig, killed):
    first = choose(rig, "cups", new=True, request=11)
    assert choose(rig, "cups", new=True, request=11) == first
    choose(rig, "model", request=12)
    if killed:
        restarted(rig, run="today")
    choose(rig, "cups", new=True, request=11)
    assert rig.described().skill == "model"


def test_an_empty_skill_whose_making_was_not_heard_of_is_made_by_who_asks_again(rig, path):
    """The process was killed after it had made it and before it had chosen it."""
    Shelf(path.parent, "robot1").new("cups", About(Binding("dishwasher", "tiago")))
    assert choose(rig, "cups", new=True, request=11).state.skill == "cups"


def test_in_the_same_run_a_restart_goes_on_with_what_was_chosen_and_another_run_with_what_is_configured(rig):
    restarted(rig, run="today")
    choose(rig, "cups", new=True)
    assert restarted(rig).described().skill == "cups"
    assert restarted(rig, skill="model").described().skill == "cups"
    assert restarted(rig, run="tomorrow").described().skill == "model"
    assert restarted(rig, run="later", skill="cups").described().skill == "cups"


def test_where_nothing_is_configured_the_next_run_goes_on_with_the_last_choice_for_its_task(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    rig = Rig("")
    assert rig.described().skill == "dishwasher"
    choose(rig, "cups", new=True)
    rig.service.close()
    assert restarted(rig, run="tomorrow").described().skill == "cups"
    assert Rig("", scene="table").described().skill == "table"
    rig.service.close()
    Shelf(tmp_path / "retouch" / "robot1", "robot1").drop("cups")
    assert restarted(rig).described().skill == "dishwasher"


def test_a_skill_that_does_not_fit_is_listed_with_the_reason_and_refused_in_one_line(rig, path):
    rig.teach(Purpose.INITIAL)
    Shelf(path.parent, "robot1").new("plates", About(PLATES))
    reason = "skill 'plates' is for task table on tiago; this robot is tiago in dishwasher: choose another skill"
    assert {one.name: one.misfit for one in listed(rig).skills} == {"model": "", "plates": reason}
    assert choose(rig, "plates").reason == reason
    assert rig.described().skill == "model"
    with pytest.raises(SkillMisfit, match=reason):
        restarted(rig, skill="plates")


@pytest.mark.parametrize("name", ["plates", "", "../plates", "MODEL"])
def test_what_is_not_there_is_not_chosen_and_what_is_there_or_no_name_is_not_made(rig, name):
    assert isinstance(choose(rig, name), Refused)
    if name != "plates":
        assert isinstance(choose(rig, name, new=True), Refused)
    assert (rig.described().skill, len(listed(rig).skills)) == ("model", 1)


def test_a_skill_with_something_learnt_is_not_made_again(rig):
    rig.teach(Purpose.INITIAL)
    assert "is there already" in choose(rig, "model", new=True).reason


def test_a_configured_skill_that_is_not_there_is_named(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    with pytest.raises(NoSuchSkill, match=r"there is no skill 'cups'.*'retouch skill list'"):
        restarted(Rig(""), skill="cups")


def test_a_skill_whose_model_cannot_be_made_leaves_the_one_in_use(rig, path):
    choose(rig, "cups", new=True)
    rig.teach(Purpose.INITIAL)
    choose(rig, "model")

    def fit(_):
        raise LfdError("it does not converge")

    models = {"adaptive": fit}
    rig.service.close()
    rig.network = MemoryNetwork(ManualClock())
    rig.service, rig.asker = build(rig.network.bus(), rig.clock, rig.configuration, models), rig.network.bus()
    assert "converge" in choose(rig, "cups").reason
    assert isinstance(rig.ask(queries.DESCRIBE, queries.Describe()), Learnt)
    assert rig.described().skill == "model"
    Shelf(path.parent, "robot1").drop("cups")


def test_a_choice_that_cannot_be_read_is_named_with_what_to_do(path):
    (path.parent / FILE).write_text("{")
    with pytest.raises(ChoiceLost, match=r"in-use\.json.*delete it"):
        Rig(path)


def test_any_suffix_or_none_of_a_configured_file_is_its_skills(tmp_path):
    for file in ("cups.db", "cups"):
        rig = Rig(tmp_path / file)
        assert [one.name for one in listed(rig).skills] == ["cups"]
        rig.service.close()
    assert ModelSection().skill == ""
