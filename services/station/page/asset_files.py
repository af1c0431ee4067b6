"""The page's own files as browsers load them: its sheets as one, its scripts each by itself, its symbols."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from services.web import look
from services.web.look import joined
from services.web.shelf import ASKED_FOR, File, Shelf, file

ASSETS = Path(__file__).parent / "assets"
ADDRESS = "/assets"

_KINDS = {".js": "text/javascript", ".svg": "image/svg+xml"}
_SHEETS = (
    "base",
    "light",
    "layout",
    "header",
    "scene",
    "cameras",
    "timeline",
    "gripper",
    "showing",
    "methods",
    "guide",
    "actions",
    "verdict",
    "history",
    "skills",
    "pad",
    "devices",
    "stop",
    "banners",
    "roles",
    "robots",
    "tour",
    "compact",
    "narrow",
    "settled",
    "contrast",
)
"""In order: what comes later counts more."""

_LOGIN_SHEETS = ("base", "light", "login", "contrast")
"""Those of the log-in, which shows nothing of the station."""

_STYLE, _LOGIN_STYLE = "station.css", "login.css"
STYLE_ADDRESS, LOGIN_STYLE_ADDRESS = f"{ADDRESS}/{_STYLE}", f"{ADDRESS}/{_LOGIN_STYLE}"
ICON_ADDRESS, SYMBOLS_ADDRESS = f"{ADDRESS}/retouch.svg", f"{ADDRESS}/symbols.svg"


def _address(path: Path) -> str:
    return path.relative_to(ASSETS).as_posix()


SCRIPT_ADDRESSES = tuple(f"{ADDRESS}/{_address(path)}" for path in sorted(ASSETS.rglob("*.js")))


def asset_files() -> Shelf:
    """All of them, by their addresses below /assets/, as they are on the disk now."""
    others = {_address(path): path for path in ASSETS.rglob("*.js")} | {
        path.name: path for path in look.FOLDER.glob("*.svg")
    }
    files = {address: file(_KINDS[path.suffix], path.read_bytes()) for address, path in others.items()}
    return Shelf({**files, _STYLE: _style(_SHEETS), _LOGIN_STYLE: _style(_LOGIN_SHEETS)}, ASKED_FOR)


def _style(sheets: Sequence[str]) -> File:
    return file("text/css", joined(sheets, ASSETS / "css").encode())
