"""The page as the browser loads it, once. What changes on it later comes over the link, value by value."""

from __future__ import annotations

import hashlib
from html import escape
from pathlib import Path
from string import Template

from protocol.messages import SHORTEST_REASON
from services.station.page.controls import BUTTONS, KEYBOARDS, Button, Key
from services.station.page.devices import PADS
from services.station.page.panels import CHIPS, COUNTERS, CRITERIA

HERE = Path(__file__).parent
ASSETS = HERE / "assets"

_SHEETS = (
    "base",
    "light",
    "header",
    "cameras",
    "scene",
    "status",
    "keys",
    "devices",
    "actions",
    "stop",
    "banners",
    "roles",
    "compact",
)
_SYMBOLS = {"retouch": "brand", "view": "", "red": "lamp", "amber": "lamp", "hold": "lamp", "green": "lamp", "stop": ""}
"""Those that stand in page.html, and the class by which the style sheet sizes them."""

_CAMERAS = (("head", "Head camera"), ("wrist", "Wrist camera"))


def document(robot: str, description: str) -> str:
    """The page's HTML.

    Args:
        robot: its name.
        description: address of what the live view is told once.
    """
    parts = {
        "robot": escape(robot),
        "description": escape(description),
        "sheets": "\n".join(f'    <link rel="stylesheet" href="/assets/css/{name}.css" />' for name in _SHEETS),
        "chips": "".join(_chip(name, title) for name, title in CHIPS),
        "cameras": "".join(_camera(name, title) for name, title in _CAMERAS),
        "counters": "".join(_counter(name, title) for name, title in COUNTERS),
        "criteria": "".join(_criterion(name, title) for name, title in CRITERIA),
        "devices": _devices(),
        "actions": "".join(_button(button) for button in BUTTONS),
        "shortest": str(SHORTEST_REASON),
        **{f"icon_{name}": _icon(name, size) for name, size in _SYMBOLS.items()},
    }
    return Template((HERE / "page.html").read_text(encoding="utf-8")).substitute(parts, version=version())


def version() -> str:
    """Changes with the page's files: a tab that was loaded from others says that it is to be loaded anew."""
    files = [HERE / "page.html", HERE / "devices.html", *sorted(path for path in ASSETS.rglob("*") if path.is_file())]
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()[:12]


def _icon(name: str, size: str = "") -> str:
    """A symbol out of assets/symbols.svg, in the colour of the text around it."""
    return (
        f'<span class="icon icon-{name} {size}"><svg viewBox="0 0 24 24" aria-hidden="true">'
        f'<use href="/assets/symbols.svg#{name}"/></svg></span>'
    )


def _chip(name: str, title: str) -> str:
    return (
        f'<div class="chip" data-chip="{name}" data-value="chip-{name}" data-tone="none">'
        f'<div class="chip-title">{title}</div><div class="chip-value" data-value="chip-{name}-text">none</div></div>'
    )


def _camera(name: str, title: str) -> str:
    return (
        f'<div class="panel camera" data-camera="{name}" data-state="waiting"><canvas class="picture"></canvas>'
        f'<div class="camera-empty">No picture yet</div>'
        f'<div class="caption"><span>{title}</span><span class="camera-age"></span></div></div>'
    )


def _counter(name: str, title: str) -> str:
    return (
        f'<div class="counter" data-counter="{name}"><div class="counter-title">{title}</div>'
        f'<div class="counter-value" data-value="{name}">none</div>'
        f'<div class="counter-bar" data-value="{name}-bar"></div></div>'
    )


def _criterion(name: str, title: str) -> str:
    symbols = "".join(_icon(symbol) for symbol in ("check", "cross", "dash"))
    return (
        f'<div class="criterion" data-value="{name}" data-tone="none">{symbols}'
        f'<div class="criterion-title">{title}</div>'
        f'<div class="criterion-evidence" data-value="{name}-evidence"></div></div>'
    )


def _devices() -> str:
    """The panel of the devices."""
    tabs = "".join(
        f'<button type="button" class="device-tab" role="tab" data-pad-for="{name}">{words}</button>'
        for name, words in PADS
    )
    keyboards = "".join(_keyboard(rows) for rows in KEYBOARDS)
    return Template((HERE / "devices.html").read_text(encoding="utf-8")).substitute(tabs=tabs, keyboards=keyboards)


def _keyboard(rows: tuple[tuple[Key, ...], ...]) -> str:
    return f'<div class="keyboard">{"".join(_key(key) for row in rows for key in row)}</div>'


def _key(key: Key) -> str:
    return (
        f'<div class="key" data-key="{key.code}" data-cap="{key.cap}"><div class="key-cap">{key.cap}</div>'
        f'<div class="key-axis" data-axis="{key.axis[-1]}">{key.axis}</div>'
        f'<div class="key-direction">{key.direction}</div></div>'
    )


def _button(button: Button) -> str:
    asks = f'data-question="{button.question}" ' if button.question else ""
    return (
        f'<button type="button" class="action" data-action="{button.action}" data-value="action-{button.action}" '
        f'{asks}disabled>{_icon(button.symbol)}<span class="action-label">{button.label}</span>'
        f'<span class="action-hint">{button.hint}</span></button>'
    )
