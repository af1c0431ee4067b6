"""The page as the browser loads it, once. What changes on it later comes over the link, value by value."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from html import escape
from pathlib import Path
from string import Template

import msgspec

from protocol.messages import SHORTEST_REASON, Role
from services.station.live_view.files import Files as LiveFiles
from services.station.page.asset_files import ASSETS, SCRIPT_ADDRESSES, STYLE_ADDRESS
from services.station.page.controls import BUTTONS, KEYBOARDS, Button, Key
from services.station.page.devices import PADS
from services.station.page.guide import STEPS
from services.station.page.health import FIGURES
from services.station.page.methods import BASES, METHODS
from services.station.page.panels import COUNTERS, CRITERIA
from services.station.page.people import GROUPS
from services.station.page.robots import SLOTS
from services.station.words.table import say, speech
from services.web import look
from sim.robots.robot import USUAL_CAMERAS

HERE = Path(__file__).parent
PARTS = HERE / "parts"

_SYMBOLS = {"retouch": "brand", "view": "", "red": "lamp", "amber": "lamp", "hold": "lamp", "green": "lamp", "stop": ""}
"""Those that stand in the parts, and the class by which the style sheet sizes them."""

_LIVE = "live"
_LOADED = (".css", ".js", ".svg")
_SCRIPTS = ("script", "tour", "waypoint", "entry")
"""Sections of the words that the scripts say."""


class _Html(Template):
    """A part of the page: "$name" is HTML that was made, "${section.name}" a word of the table."""

    braceidpattern = r"[a-z][a-z0-9_]*\.[a-z0-9_]+"


def document(
    robot: str,
    view: LiveFiles,
    cameras: Iterable[str] = USUAL_CAMERAS,
    *,
    settled: Iterable[str] = (),
    framed: bool = False,
) -> str:
    """The page's HTML, in the language that the process speaks.

    Args:
        robot: its name.
        view: what the live view loads.
        cameras: their names.
        settled: names of the actions that are never the operator's: what does nothing else is not shown.
        framed: it is shown in the frame of a page that says who is there and what is taught.
    """
    made = {
        "language": escape(speech.language),
        "title": escape(say("document.title", robot=robot)),
        "robot": escape(robot),
        "description": escape(view.description_address),
        "version": version(),
        "settled": " ".join(sorted(settled)),
        "framed": "yes" if framed else "no",
        "style": STYLE_ADDRESS,
        "ahead": "\n".join(_ahead(view)),
        "words": _for_scripts(),
        "shortest": str(SHORTEST_REASON),
        "figures": "".join(_figure(name) for name in FIGURES),
        "cameras": "".join(_camera(name) for name in cameras),
        "swap_live": _swap(_LIVE, say("scene.live")),
        "counters": "".join(_counter(name) for name in COUNTERS),
        "criteria": "".join(_criterion(name) for name in CRITERIA),
        "robot_slots": "".join(_robot(slot) for slot in SLOTS),
        "people": "".join(_people(group) for group in GROUPS),
        "roles": "".join(_role(role) for role in Role),
        "show_steps": "".join(_show_step(number, name) for number, name in enumerate(STEPS, 1)),
        "methods_choices": "".join(_choice("method", one.value, _say(f"method.{one.value}")) for one in METHODS),
        "bases_choices": "".join(_choice("basis", one.value, _say(f"basis.{one.value}")) for one in BASES),
        "pads": "".join(_pad(name) for name in PADS),
        "keyboards": "".join(_keyboard(rows) for rows in KEYBOARDS),
        "actions": "".join(_button(number, button) for number, button in enumerate(BUTTONS)),
        **{f"icon_{name}": _icon(name, size) for name, size in _SYMBOLS.items()},
        **{f"icon_{name}": _icon(name) for name in ("step_back", "pause", "step_on")},
        "icon_go": _icon("play"),
        **{name: escape(words) for name, words in speech.words.items()},
    }
    parts = {part.stem: _filled(part, made) for part in PARTS.glob("*.html")}
    return _filled(HERE / "page.html", {**made, **parts})


def version() -> str:
    """Changes with the page's files: a tab that was loaded from others says that it is to be loaded anew."""
    assets = sorted(path for folder in (ASSETS, look.FOLDER) for path in folder.rglob("*.*") if path.suffix in _LOADED)
    files = [HERE / "page.html", *sorted(PARTS.glob("*.html")), *assets]
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()[:12]


def _ahead(view: LiveFiles) -> Iterable[str]:
    """Says at once all that is going to be loaded: else each script names the next ones only when it has come."""
    for address in (*SCRIPT_ADDRESSES, *view.library_addresses):
        yield f'    <link rel="modulepreload" href="{escape(address)}" />'
    for address in (view.description_address, view.shapes_address):
        yield f'    <link rel="preload" as="fetch" crossorigin href="{escape(address)}" />'


def _filled(file: Path, made: Mapping[str, str]) -> str:
    return _Html(file.read_text(encoding="utf-8").rstrip("\n")).substitute(made)


def _for_scripts() -> str:
    """What the scripts say, as data that no browser runs: nothing in it ends the element that holds it."""
    words = {key: words for key, words in speech.words.items() if key.partition(".")[0] in _SCRIPTS}
    return msgspec.json.encode(words).decode().replace("<", "\\u003c")


def _icon(name: str, size: str = "") -> str:
    """A symbol out of assets/symbols.svg, in the colour of the text around it."""
    return (
        f'<span class="icon icon-{name} {size}"><svg viewBox="0 0 24 24" aria-hidden="true">'
        f'<use href="/assets/symbols.svg#{name}"/></svg></span>'
    )


def _say(key: str, **facts: object) -> str:
    return escape(say(key, **facts))


def _figure(name: str) -> str:
    return (
        f'<div class="figure" data-figure="{name}"><dt>{_say(f"figure.{name}")}</dt>'
        f'<dd data-value="figure-{name}" data-tone="none">{_say("figure.none")}</dd></div>'
    )


def _robot(slot: int) -> str:
    name = f"robot-{slot}"
    return (
        f'<div class="robot" data-value="{name}" hidden><a class="robot-way" data-value="{name}-name"></a>'
        f'<span class="robot-light" data-value="{name}-light"></span>'
        f'<span class="robot-text" data-value="{name}-text"></span>'
        f'<button type="button" class="robot-stop" data-action="stop_other" data-value="{name}-stop"></button></div>'
    )


def _people(group: str) -> str:
    return (
        f'<div class="person-row" data-value="people-{group}-row" hidden><dt>{_say(f"who.{group}")}</dt>'
        f'<dd data-value="people-{group}"></dd></div>'
    )


def _role(role: Role) -> str:
    return f'<option value="{role.value}" data-value="role-{role.value}">{_say(f"who.{role.value}")}</option>'


def _camera(name: str) -> str:
    title = say(f"scene.{name}") if name in USUAL_CAMERAS else say("scene.camera", name=name)
    return (
        f'<div class="stage camera" data-stage="{name}" data-camera="{name}" data-state="waiting"'
        f' data-value="camera-{name}" data-yaw="0">'
        f'<canvas class="picture" role="img" aria-label="{escape(title)}"></canvas>'
        f'<div class="camera-empty">{_say("scene.empty")}</div>'
        f'<div class="caption"><span>{escape(title)}</span><span class="camera-age"></span></div>'
        f"{_swap(name, title)}</div>"
    )


def _swap(view: str, title: str) -> str:
    """Covers an inset: pressed, the inset and the large view change places."""
    label = _say("scene.large", view=title)
    return f'<button type="button" class="swap" data-swap="{view}" aria-label="{label}"></button>'


def _counter(name: str) -> str:
    return (
        f'<div class="counter" data-counter="{name}" title="{_say(f"history.{name}_hint")}">'
        f'<div class="counter-title">{_say(f"history.{name}")}</div>'
        f'<div class="counter-value" data-value="{name}">{_say("figure.none")}</div>'
        f'<div class="counter-bar" data-value="{name}-bar"></div></div>'
    )


def _criterion(name: str) -> str:
    symbols = "".join(_icon(symbol) for symbol in ("check", "cross", "dash"))
    return (
        f'<div class="criterion" data-value="{name}" data-tone="none">{symbols}'
        f'<div class="criterion-title">{_say(f"verdict.{name}")}</div>'
        f'<div class="criterion-evidence" data-value="{name}-evidence"></div></div>'
    )


def _pad(name: str) -> str:
    """The tab that brings a device's pad forward."""
    return (
        f'<button type="button" class="device-tab" role="tab" id="tab-{name}" aria-controls="pad-{name}"'
        f' data-pad-for="{name}">{_say(f"pad.{name}")}</button>'
    )


def _keyboard(rows: tuple[tuple[Key, ...], ...]) -> str:
    return f'<div class="keyboard">{"".join(_key(key) for row in rows for key in row)}</div>'


def _key(key: Key) -> str:
    return (
        f'<div class="key" data-key="{key.code}" data-cap="{key.cap}"><div class="key-cap">{key.cap}</div>'
        f'<div class="key-axis" data-axis="{key.axis[-1]}">{key.axis}</div>'
        f'<div class="key-direction">{_say(f"direction.{key.direction}")}</div></div>'
    )


def _show_step(number: int, name: str) -> str:
    return (
        f'<li class="show-step" data-value="showing-{name}" data-state="later">'
        f'<span class="show-number">{number}</span>{_say(f"showing.step_{name}")}</li>'
    )


def _choice(kind: str, name: str, words: str) -> str:
    """One of several, of which one is chosen."""
    return (
        f'<button type="button" class="choice" data-action="{kind}" data-argument="{name}" data-value="{kind}-{name}"'
        f' aria-pressed="false" disabled>{words}</button>'
    )


def _button(number: int, button: Button) -> str:
    asks = (
        f' data-confirm="{_say(f"confirm.{button.action}")}" data-confirm-yes="{_say(f"confirm.{button.action}_yes")}"'
        if button.confirmed
        else ""
    )
    if button.reasoned:
        asks = f' data-question="{_say(f"reason.{button.action}")}"'
    return (
        f'<button type="button" class="action" data-action="{button.action}" data-order="{number}"'
        f' data-place="{button.place}" data-value="action-{button.action}"{asks} disabled>{_icon(button.symbol)}'
        f'<span class="action-label" data-value="action-{button.action}-label">{_say(f"action.{button.action}")}</span>'
        f'<span class="action-hint">{_say(f"hint.{button.action}")}</span></button>'
    )
