"""A history of a skill, and what its entries change, for the page to show."""

import numpy as np

from protocol.messages import Method, Part, Purpose
from protocol.queries import Effect, Entry, Field, HistoryListed, SkillEntry, SkillsListed
from services.bus.arrays import motion_to_wire, to_wire
from services.station.page.entries import rows_of

VERSION = 7
PLACE = (0.845, 0.02, 0.553)


def history(version=VERSION, taken_back=(2,)):
    """Four entries, one of them taken back, as a station is told them."""
    entries = tuple(_entry(number, number not in taken_back) for number in (6, 5, 2, 1))
    return rows_of(HistoryListed(version, entries), edition=version)


def skills():
    """Four skills: one in use, one that can be, and two that do not fit."""

    def entry(name, task, robot, misfit="", notes=""):
        held = {"version": VERSION, "demonstrations": 12, "updates": 1}
        return SkillEntry(name=name, task=task, robot_kind=robot, misfit=misfit, notes=notes, **held)

    return SkillsListed(
        "dishwasher",
        (
            entry("cups-of-anna", "dishwasher", "tiago", notes="the blue ones, from the left"),
            entry("dishwasher", "dishwasher", "tiago"),
            entry("dishwasher-panda", "dishwasher", "panda", misfit="another robot"),
            entry("torn", "", "", misfit="the file is damaged; restore it from a copy"),
        ),
    )


def effect(most=0.04):
    """Of a correction at the near right: a motion that goes round, and the one before it."""
    path = np.linspace([0.5, 0.0, 0.6], PLACE, 60)
    round_it = path + np.outer(np.sin(np.pi * np.linspace(0.0, 1.0, 60)), [0.0, 0.12, 0.1])
    i, j = np.mgrid[0:7, 0:7] / 6.0
    moved = most * np.exp(-4.0 * ((i - 0.3) ** 2 + (j - 0.35) ** 2))
    known = np.clip(1.2 - i, 0.0, 1.0)
    field = Field((0, 1), (0.83, -0.08), (0.88, 0.22), to_wire(moved), to_wire(known), to_wire(known))
    return Effect(PLACE, _motion(round_it), _motion(path), field)


def _motion(positions):
    return motion_to_wire(positions, np.tile([1.0, 0.0, 0.0, 0.0], (len(positions), 1)), 10.0)


def _entry(number, in_use):
    first = number < 3
    return Entry(
        id=number,
        purpose=Purpose.INITIAL if first else Purpose.UPDATE,
        method=Method.DEMONSTRATE if first else Method.REFINE,
        operator="anna" if number % 2 else "ben",
        at=f"2026-11-27T09:{10 + number}:00+00:00",
        alpha=1.0 if number != 5 else 0.7,
        part=Part(),
        object_position=PLACE,
        mean=-1.0 if first else 0.012,
        most=-1.0 if first else 0.038,
        in_use=in_use,
        turned_by="" if in_use else "eva",
        turned_at="" if in_use else "2026-11-27T09:30:00+00:00",
    )
