"""What is done with a robot's skills: on their files, and by the model process where it has one open."""

from __future__ import annotations

import sys
from datetime import UTC, datetime

from lfd.store.database import DemonstrationStore
from lfd.store.stored import About, Purpose
from protocol import messages, queries
from protocol.messages import ModelState
from protocol.queries import ChooseSkill, Undo
from services.bus.identity import new_number
from services.commands.model_process import model_process
from services.model.exceptions import SkillOpen
from services.model.history import NoSuchEntry
from services.model.shelf import Shelf
from services.model.skill import binding_of
from services.process.config import Configuration
from services.process.exceptions import BusError, CommandFailed, NoAnswer
from services.process.robots import scene_of

LONGEST_NOTES = 1000


def new(shelf: Shelf, settings: Configuration, name: str, notes: str) -> None:
    """Make an empty skill for the task and the robot of the configuration."""
    binding = binding_of(scene_of(settings.robot))
    shelf.new(name, About(binding, settings.operator, _checked(notes), _now_s()))
    _say(f"skill {name} is there, for task {binding.scene} on {binding.robot}, and has learnt nothing yet")


def use(settings: Configuration, name: str) -> ModelState:
    """Have the running model process use a skill; what that is."""
    with model_process(settings, "history") as model:
        wanted = ChooseSkill(name, operator=settings.operator, request=new_number())
        state = model.ask(queries.CHOOSE_SKILL, wanted, f"use skill {name}").state
    _say(f"robot {settings.name} uses skill {state.skill}, version {state.version}")
    return state


def note(shelf: Shelf, name: str, notes: str) -> None:
    """Write the notes of a skill anew."""
    with shelf.read(name) as store:
        about = store.about()
        if about is None:
            raise CommandFailed(f"skill {name} does not say what it is for: teach it something first")
        store.describe(about._replace(notes=_checked(notes)))
    _say(f"skill {name} has new notes")


def rename(shelf: Shelf, name: str, renamed: str) -> None:
    """Give a skill another name."""
    shelf.rename(name, renamed)
    _say(f"skill {name} is called {renamed} from now on")


def copy(shelf: Shelf, name: str, copied: str) -> None:
    """Make another skill that has learnt the same."""
    shelf.copy(name, copied)
    _say(f"skill {copied} is there, and has learnt what {name} has")


def drop(shelf: Shelf, name: str, *, sure: bool) -> None:
    """Take a skill away, where that is meant.

    Raises:
        CommandFailed: nobody has said that it is.
    """
    skill = shelf.find(name)
    if not sure:
        held = f"{skill.counts.initial} demonstrations and {skill.counts.updates} corrections"
        raise CommandFailed(f"skill {name} holds {held}: say that you mean it with --yes")
    _say(f"skill {name} is dropped: {shelf.drop(name)}; 'retouch skill undo {name}' brings it back")


def undo(shelf: Shelf, settings: Configuration, name: str, entry: int | None) -> None:
    """Take back what a skill learnt last, or an entry; bring back a skill that was dropped, and is not there."""
    if name not in shelf.names() and name in shelf.dropped():
        shelf.bring_back(name)
        _say(f"skill {name} is there again")
        return
    try:
        with shelf.only(name) as store:
            taken = _newest(store, name) if entry is None else entry
            if all(one.version != taken for one in store.history()):
                raise NoSuchEntry(taken)
            store.undo(taken, author=settings.operator, at_s=_now_s())
    except SkillOpen as error:
        taken = _asked(settings, name, entry, error)
    _say(f"skill {name}: entry {taken} is taken back; 'retouch history --redo {taken}' uses it again")


def _asked(settings: Configuration, name: str, entry: int | None, reason: SkillOpen) -> int:
    """What the model process takes back, that has the skill open."""
    try:
        with model_process(settings, "history") as model:
            state = model.state()
            purpose = messages.Purpose.UPDATE if state.updates else messages.Purpose.INITIAL
            request = Undo(purpose, entry or 0, settings.operator, skill=name, request=new_number())
            return model.ask(queries.UNDO, request, "take it back").entry
    except (BusError, NoAnswer):
        raise reason from None


def _newest(store: DemonstrationStore, name: str) -> int:
    in_use = store.active()
    updates = [one.version for one in in_use if one.purpose is Purpose.UPDATE]
    if not in_use:
        raise CommandFailed(f"skill {name} has nothing to take back")
    return (updates or [one.version for one in in_use])[-1]


def _checked(notes: str) -> str:
    if len(notes) > LONGEST_NOTES:
        raise CommandFailed(f"the notes have {len(notes)} characters: give {LONGEST_NOTES} at most")
    return notes


def _now_s() -> float:
    return datetime.now(UTC).timestamp()


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
