"""Puts the values of the page's regions together: what all tabs show alike, and what each shows of its own."""

from __future__ import annotations

from services.station.page.commanding import commanding
from services.station.page.controls import actions, emergency_stop
from services.station.page.devices import devices
from services.station.page.gripper import gripper
from services.station.page.guide import guide
from services.station.page.health import commander, figures, health
from services.station.page.history import history
from services.station.page.methods import methods
from services.station.page.panels import counters, scene, traffic_light, verdict
from services.station.page.people import people
from services.station.page.robots import robots
from services.station.page.seating import seating
from services.station.page.skills import skills
from services.station.page.standing import Standing
from services.station.page.timeline import timeline
from services.station.page.values import Values
from services.station.page.view import Shown


def shared(shown: Shown) -> Values:
    """What every tab shows now.

    Args:
        shown: the newest view.
    """
    return {
        **robots(shown),
        **health(shown),
        **figures(shown),
        **scene(shown),
        **counters(shown),
        **verdict(shown),
        **actions(shown),
        **guide(shown),
        **methods(shown),
        **timeline(shown),
        **gripper(shown),
        **history(shown),
        **skills(shown),
        **devices(shown),
    }


def own(shown: Shown, standing: Standing) -> Values:
    """What a tab shows besides.

    Args:
        shown: the newest view.
        standing: of the tab.
    """
    return {
        **commanding(shown, standing),
        **people(shown, standing),
        **commander(shown, standing),
        **traffic_light(shown, standing),
        **emergency_stop(shown, standing),
        **seating(standing),
    }
