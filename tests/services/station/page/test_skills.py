"""The page's list of skills: which is in use, what each is for, and why some cannot be chosen here."""

import json

from views import shown, teaching

from protocol.messages import ModelState
from protocol.queries import SkillEntry, SkillsListed
from services.station.page.skills import skills

CUPS = SkillEntry(
    name="cups", task="table", robot_kind="tiago", version=3, demonstrations=2, updates=1, notes="<b>blue</b>"
)
PLATES = SkillEntry(
    name="plates", task="rack", robot_kind="panda", version=0, demonstrations=0, updates=0, misfit="it is for a panda"
)
BROKEN = SkillEntry(name="broken", task="", robot_kind="", version=0, demonstrations=0, updates=0, misfit="damaged")
LISTED = SkillsListed("cups", (BROKEN, CUPS, PLATES))
MODEL = ModelState(kind="adaptive", version=3, demonstrations=2, updates=1, scene="table", skill="cups")


def values(*actions, listed=LISTED, model=MODEL):
    return skills(shown(teaching=teaching(actions=actions), skills=listed, model=model))


def test_each_says_what_it_is_for_and_has_learnt_and_why_it_cannot_be_chosen():
    broken, cups, plates = json.loads(values()["skills@data-listed"])
    assert cups == {"name": "cups", "what": "For table, tiago. Shown 2, corrected 1", "why": "", "notes": "<b>blue</b>"}
    assert plates["why"] == "Does not fit here"
    assert broken["why"] == "damaged"


def test_the_one_in_use_is_as_the_model_says_at_once():
    assert values(model=MODEL, listed=SkillsListed("old", ()))["skill-name"] == "cups"


def test_they_can_be_chosen_while_the_workflow_offers_it():
    assert values("skill", "new_skill", "execute")["skills@data-allowed"] == "skill new_skill"
    assert values("execute")["skills@data-allowed"] == ""


def test_before_anything_was_heard_there_is_none():
    found = skills(shown())
    assert (found["skill-name"], found["skills@data-listed"], found["skills@data-allowed"]) == ("", "[]", "")
