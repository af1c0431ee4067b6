"""What there is to know of a robot's skills, at a terminal."""

from __future__ import annotations

from rich.table import Table
from rich.text import Text

from lfd.store.stored import Counts
from protocol.queries import HistoryListed
from services.commands.history import print_wide, rows_table
from services.commands.terminal import Terminal
from services.model.choice import Choice
from services.model.history import iso, told
from services.model.shelf import Shelf
from services.model.skill_file import Skill
from services.process.lines import readable, when
from services.station.page.entries import rows_of


def list_all(shelf: Shelf) -> None:
    """Print every skill, and those that were dropped."""
    console = Terminal(highlight=False)
    skills = shelf.all()
    if not skills:
        _say(console, f"robot {shelf.robot} has no skill yet; 'retouch skill new NAME --task T' makes an empty one")
    else:
        choice = Choice(shelf.folder)
        table = _table("skill", "task", "robot", "version", "shown", "corrected", "used last", "by", "notes")
        for skill in skills:
            table.add_row(*(Text(readable(word)) for word in _row(skill, choice)), style="red" if skill.fault else "")
        print_wide(console, table)
        if any(map(choice.chose, (skill.about.binding for skill in skills if skill.about is not None))):
            _say(console, "* is the one that is used for its task")
    for name in shelf.dropped():
        _say(console, f"dropped: {name}; 'retouch skill undo {name}' brings it back")


def show(shelf: Shelf, name: str) -> None:
    """Print what a skill has learnt, entry by entry.

    Raises:
        NoSuchSkill: there is none.
        StorageError: its file cannot be used.
    """
    console = Terminal(highlight=False)
    skill = shelf.find(name)
    with shelf.read(name) as store:
        history = store.history()
    if skill.about is not None:
        about = skill.about
        _say(console, f"{name}: task {about.binding.scene or '?'} on {about.binding.robot or 'any robot'}")
        made = when(iso(about.created_s)) or "nobody knows when"
        _say(console, f"made {made}{f' by {about.author}' if about.author else ''}; used last {_used(skill)}")
        if about.notes:
            _say(console, about.notes)
    _say(console, f"version {skill.version}: {_counted(skill.counts)}, {_taken_back(skill, len(history))} taken back")
    _say(console, f"file {skill.path}, {skill.path.stat().st_size / 1e6:.2f} MB")
    if history:
        rows = rows_of(HistoryListed(skill.version, tuple(told(one) for one in reversed(history))))
        print_wide(console, rows_table(rows.rows))


def _row(skill: Skill, choice: Choice) -> tuple[str, ...]:
    if skill.about is None:
        return skill.name, *("-",) * 7, skill.fault
    about, binding = skill.about, skill.about.binding
    mark = " *" if choice.of(binding) == skill.name else ""
    first = about.notes.partition("\n")[0]
    return (
        f"{skill.name}{mark}",
        *(binding.scene or "-", binding.robot or "any"),
        *map(str, (skill.version, skill.counts.initial, skill.counts.updates)),
        *(_used(skill), about.author or "-", first),
    )


def _counted(counts: Counts) -> str:
    if not sum(counts):
        return "nothing yet"
    return f"{_number(counts.initial, 'demonstration')}, {_number(counts.updates, 'correction')}"


def _number(count: int, what: str) -> str:
    return f"{count} {what}{'' if count == 1 else 's'}"


def _taken_back(skill: Skill, all_of_it: int) -> int:
    return all_of_it - sum(skill.counts)


def _used(skill: Skill) -> str:
    used = when(iso(skill.about.used_s)) if skill.about is not None else ""
    return used or "never"


def _table(*headings: str) -> Table:
    table = Table(box=None, pad_edge=False)
    for heading in headings:
        table.add_column(heading, overflow="fold")
    return table


def _say(console: Terminal, line: str) -> None:
    console.print(readable(line), markup=False, soft_wrap=True)
