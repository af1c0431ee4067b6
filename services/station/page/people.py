"""Who is at the robot's pages, by name: who commands, who else may, who looks on. Nobody does so unseen."""

from __future__ import annotations

from collections.abc import Iterator

from protocol.messages import Person, Role
from services.station.page.standing import Standing
from services.station.page.values import Values
from services.station.page.view import PageView, Shown
from services.station.words.table import say

GROUPS = ("commands", "second", "watching", "supervising")
"""In which the page lists people."""


def people(shown: Shown, standing: Standing) -> Values:
    """Everybody at every page of the robot, and what this tab's person said of themselves."""
    others = _others(shown.view, standing)
    values: dict[str, str | bool] = {
        "who-others": others,
        "who-others@title": others,
        "who-you": say(f"who.as_{standing.identity.role.value}", name=_named(standing.identity.name)),
        "who-fault": standing.identity.fault,
        "who@data-role": standing.identity.role.value,
        **_account(standing.identity.account),
    }
    named = {group: ", ".join(names) for group, names in _groups(shown.view).items()}
    for group in GROUPS:
        values[f"people-{group}"] = named[group]
        values[f"people-{group}-row@hidden"] = not named[group]
    return values


def _account(most: Role | None) -> Values:
    """What somebody may say of themselves: who has logged in is who they are, and no more than their account says."""
    allowed = set(Role) if most is None else {most, Role.OBSERVER}
    return {
        "who-form@data-account": "" if most is None else most.value,
        "who-say": say("who.say" if most is None else "who.change"),
        "log-out@hidden": most is None,
        **{f"role-{role.value}@hidden": role not in allowed for role in Role},
    }


def _groups(view: PageView) -> dict[str, list[str]]:
    groups: dict[str, list[str]] = {group: [] for group in GROUPS}
    for group, person in _everybody(view):
        groups[group].append(_named(person.name))
    return groups


def _everybody(view: PageView) -> Iterator[tuple[str, Person]]:
    """Each person with their group; who has the input of the station that commands, commands."""
    holder = view.authority.holder if view.authority is not None else ""
    for attendance in view.attendances:
        for person in attendance.people:
            match person.role:
                case Role.OBSERVER:
                    yield "watching", person
                case Role.SUPERVISOR:
                    yield "supervising", person
                case _ if person.has_input and holder and attendance.holder == holder:
                    yield "commands", person
                case _:
                    yield "second", person


def _others(view: PageView, standing: Standing) -> str:
    """In a line who is there besides who commands and this tab's own person."""
    told = [(group, person) for group, person in _everybody(view) if group != "commands"]
    own = next((at for at, (_, person) in enumerate(told) if _is(person, standing)), None)
    if own is not None and not standing.armed:
        del told[own]
    return ", ".join(say(f"who.{group}_too", name=_named(person.name)) for group, person in told)


def _is(person: Person, standing: Standing) -> bool:
    return (person.name, person.role) == (standing.identity.name, standing.identity.role)


def _named(name: str) -> str:
    return name or say("who.somebody")
