"""The page's own files as browsers load them: its sheets as one, its scripts each by itself, its symbols."""

from __future__ import annotations

from pathlib import Path

from services.station.shelf import ASKED_FOR, Shelf, file

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
    "methods",
    "guide",
    "actions",
    "verdict",
    "history",
    "pad",
    "devices",
    "stop",
    "banners",
    "roles",
    "robots",
    "tour",
    "compact",
    "narrow",
    "contrast",
)
"""In order: what comes later counts more."""

_STYLE = "station.css"
STYLE_ADDRESS = f"{ADDRESS}/{_STYLE}"


def _address(path: Path) -> str:
    return path.relative_to(ASSETS).as_posix()


SCRIPT_ADDRESSES = tuple(f"{ADDRESS}/{_address(path)}" for path in sorted(ASSETS.rglob("*.js")))


def asset_files() -> Shelf:
    """All of them, by their addresses below /assets/, as they are on the disk now."""
    style = "\n".join((ASSETS / "css" / f"{name}.css").read_text(encoding="utf-8") for name in _SHEETS)
    others = {path: _KINDS[path.suffix] for path in ASSETS.rglob("*") if path.suffix in _KINDS}
    files = {_address(path): file(kind, path.read_bytes()) for path, kind in others.items()}
    return Shelf({**files, _STYLE: file("text/css", style.encode())}, ASKED_FOR)
