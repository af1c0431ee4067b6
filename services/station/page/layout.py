"""Puts the page's regions together and keeps them up to date, for each browser tab on its own."""

from __future__ import annotations

from typing import Protocol

from nicegui import ui

from services.station.page.controls import Actions, EmergencyStop, keys
from services.station.page.elements import block, text
from services.station.page.panels import Counters, Header, Scene, TrafficLight, VerdictPanel, cameras
from services.station.page.view import Board, Shown

REFRESH_S = 0.1

_HEAD = """
<link rel="stylesheet" href="/assets/station.css">
<script type="module" src="/assets/station.js"></script>
"""


class Region(Protocol):
    """A part of the page that follows the view."""

    def update(self, shown: Shown) -> None:
        """Show it."""
        ...


def build(robot: str, board: Board) -> None:
    """Build the page in the current NiceGUI client.

    Args:
        robot: its name.
        board: where the newest view hangs.
    """
    ui.add_head_html(_HEAD)
    request = ui.context.client.request
    with block("station"):
        header = Header(robot)
        cameras()
        scene = Scene(request.url.hostname or "")
        with block("status"):
            light, counters, verdict = TrafficLight(), Counters(), VerdictPanel()
        with block("controls"):
            keys()
            actions, stop = Actions(), EmergencyStop()
    _banners()
    regions: tuple[Region, ...] = (header, scene, light, counters, verdict, actions, stop)

    def refresh() -> None:
        shown = board.newest()
        for region in regions:
            region.update(shown)

    refresh()
    ui.timer(REFRESH_S, refresh)


def _banners() -> None:
    """What covers the page where this tab does not command; the page's script says which one counts."""
    with block("banner banner-offline"):
        text("No connection to the station: nothing you press reaches the robot.", "banner-text")
    with block("banner banner-view-only"):
        text("Another tab has the input; here you can only stop.", "banner-text")
        with block("banner-button", "button").props("type=button data-take-input"):
            text("Take the input here", "banner-label")
