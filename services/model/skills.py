"""All skills of a robot, and the one in use: the model process predicts by it, and learns into it."""

from __future__ import annotations

import logging
from collections.abc import Callable
from pathlib import Path

from lfd.exceptions import BoundElsewhere
from lfd.store.database import DemonstrationStore
from lfd.store.stored import About, Binding
from protocol.messages import LONGEST_REASON
from protocol.queries import SKILLS_AT_ONCE, ChooseSkill, SkillEntry, SkillsListed
from services.model.choice import Choice
from services.model.exceptions import NoSuchSkill
from services.model.history import History, iso
from services.model.shelf import Shelf
from services.model.skill_file import Skill
from services.process.config import ModelSection
from services.process.files import data_folder
from sim.robots.catalogue import DEFAULT_NAME
from sim.robots.robot import PARTICLE

log = logging.getLogger(__name__)

_EARLIER = "model"
"""The skill in which an earlier version kept all that a robot learnt, whatever the task."""


def shelf_of(section: ModelSection, robot: str) -> Shelf:
    """Where a robot's skills lie: in the user's data folder, or beside the file that is configured.

    Args:
        section: of the configuration.
        robot: its name on the network.

    Raises:
        EnvironmentFault: the folder cannot be made or written.
    """
    if section.database:
        path = Path(section.database)
        return Shelf(path.parent, robot, path.suffix)
    return Shelf(data_folder() / robot, robot)


def own_skill(section: ModelSection, shelf: Shelf, binding: Binding) -> str:
    """The skill that a robot has for a task where nobody names one: that of the file that is configured, or the task's.

    Args:
        section: of the configuration.
        shelf: where skills lie.
        binding: what it is for.

    Raises:
        StorageError: what an earlier version has kept cannot be used.
    """
    return _EARLIER if not section.database and _is_kept(shelf, binding) else _own(section, binding)


def is_own(section: ModelSection, binding: Binding, name: str) -> bool:
    """Whether a skill is the one that a robot has for a task by itself: any other one somebody has made on purpose."""
    return name in (_own(section, binding), _EARLIER)


def _own(section: ModelSection, binding: Binding) -> str:
    if section.database:
        path = Path(section.database)
        return path.stem if path.suffix else path.name
    ours = binding.robot in (DEFAULT_NAME, PARTICLE.kind)
    return binding.scene if ours else f"{binding.scene}-{binding.robot}"


def _is_kept(shelf: Shelf, binding: Binding) -> bool:
    """Whether the file that an earlier version kept everything in holds what is wanted."""
    if _EARLIER not in shelf.names():
        return False
    with shelf.read(_EARLIER) as store:
        try:
            store.check(binding)
        except BoundElsewhere:
            return False
        return bool(store.active())


class Skills:
    """The skills of a robot in a task.

    Args:
        section: of the configuration.
        robot: whose they are, by its name on the network.
        binding: what is wanted of them.
        made: the history in a file, its model fitted.
        now_s: since 1970-01-01 UTC [s].

    Raises:
        StorageError: the file of the skill in use cannot be used.
        SkillError: it is for something else, or is not there.
        EnvironmentFault: the folder cannot be made or written.
    """

    def __init__(
        self,
        section: ModelSection,
        robot: str,
        binding: Binding,
        made: Callable[[DemonstrationStore], History],
        now_s: Callable[[], float],
    ) -> None:
        self._shelf = shelf_of(section, robot)
        self._binding = binding
        self._made = made
        self._now_s = now_s
        self._choice = Choice(self._shelf.folder)
        self.name = self._first(section)
        self.history = self._opened(self.name)
        self._choice.make(binding, self.name, run=section.run)

    def listed(self) -> SkillsListed:
        """Each of them, with why it does not fit where it does not."""
        return SkillsListed(self.name[:64], tuple(map(self._told, self._shelf.all()[:SKILLS_AT_ONCE])))

    def choose(self, request: ChooseSkill) -> None:
        """Take another skill into use, an empty one where that is asked for; nothing where that has been done.

        Raises:
            SkillError: there is none of the name, it does not fit, or one is to be made that is there.
            StorageError: its file cannot be used.
            LfdError: its model cannot be made.
            CannotWrite: the choice cannot be kept.
        """
        if request.request and self._choice.knows(request.request):
            return
        name = request.name
        if request.new and not self._is_empty(name):
            about = About(self._binding, request.operator, request.notes, self._now_s())
            self._shelf.new(name, about)
        elif not request.new and name not in self._shelf.names():
            raise NoSuchSkill(name, self._shelf.names(), self._shelf.folder)
        if name == self.name:
            self._choice.make(self._binding, name, request.request)
            return
        history = self._opened(name)
        try:
            self._choice.make(self._binding, name, request.request)
        except BaseException:
            history.close()
            raise
        self.history.close()
        self.history, self.name = history, name
        log.info("skill %r is in use: version %d", name, history.version)

    def close(self) -> None:
        """Close the file of the one in use."""
        self.history.close()

    def _first(self, section: ModelSection) -> str:
        """What was chosen in this run, or is configured, or was chosen last; else the task's own."""
        chosen = self._choice.of(self._binding)
        there = chosen if chosen in self._shelf.names() else ""
        if there and section.run and self._choice.run == section.run:
            return there
        if section.skill:
            if section.skill not in self._shelf.names():
                raise NoSuchSkill(section.skill, self._shelf.names(), self._shelf.folder)
            return section.skill
        if there and not section.database:
            return there
        if chosen and not there:
            log.warning("skill %r, which was in use last, is not there any more", chosen)
        return own_skill(section, self._shelf, self._binding)

    def _opened(self, name: str) -> History:
        store = self._shelf.take(name, self._binding, self._now_s())
        try:
            return self._made(store)
        except BaseException:
            store.close()
            raise

    def _is_empty(self, name: str) -> bool:
        """There is an empty skill of the name that fits: it was asked for, and the answer was lost."""
        if name not in self._shelf.names():
            return False
        there = self._shelf.find(name)
        return not there.version and not there.misfit(self._binding)

    def _told(self, skill: Skill) -> SkillEntry:
        about = skill.about or About(Binding("", ""))
        return SkillEntry(
            name=skill.name[:64],
            task=about.binding.scene[:64],
            robot_kind=about.binding.robot[:64],
            version=skill.version,
            demonstrations=skill.counts.initial,
            updates=skill.counts.updates,
            author=about.author[:64],
            notes=about.notes[:LONGEST_REASON],
            created=iso(about.created_s),
            used=iso(about.used_s),
            misfit=skill.misfit(self._binding)[:LONGEST_REASON],
        )
