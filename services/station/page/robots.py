"""The strip of the other robots: a slot each, with its light, who commands it, the way to its page, and its stop."""

from __future__ import annotations

from services.station.neighbours import NEIGHBOURS_KEPT, Neighbour
from services.station.page.controls import stop_state
from services.station.page.values import Values
from services.station.page.view import Shown
from services.station.words.table import say

SLOTS = range(NEIGHBOURS_KEPT)


def robots(shown: Shown) -> Values:
    """What stands in each slot; the strip is there only where there is another robot."""
    neighbours = shown.view.neighbours
    values: dict[str, str | bool] = {"robots@hidden": not neighbours}
    for slot in SLOTS:
        values.update(_slot(slot, neighbours[slot] if slot < len(neighbours) else None))
    return values


def _slot(slot: int, neighbour: Neighbour | None) -> Values:
    name = f"robot-{slot}"
    if neighbour is None:
        return {f"{name}@hidden": True}
    unheard = neighbour.safety is None
    light = "unheard" if unheard else neighbour.light.value if neighbour.light is not None else "none"
    stop = stop_state(neighbour.stopping, neighbour.safety)
    who = neighbour.commander
    return {
        f"{name}@hidden": False,
        f"{name}@data-light": light,
        f"{name}@data-stop": stop,
        f"{name}-name": neighbour.robot,
        f"{name}-name@data-address": neighbour.page,
        f"{name}-text": say("robots.unheard") if unheard else say("who.other", name=who) if who else say("who.nobody"),
        f"{name}-light": say(f"robots.{light}"),
        f"{name}-stop": say(f"robots.stop_{stop}"),
        f"{name}-stop@data-argument": neighbour.robot,
        f"{name}-stop@aria-label": say("robots.stop", robot=neighbour.robot, state=say(f"robots.stop_{stop}")),
    }
