"""The pages as the browser loads them, once: a frame of each, and all words in all languages."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from functools import cache
from html import escape
from pathlib import Path
from string import Template

import msgspec

from services.study import words
from services.web import look
from services.web.look import joined
from services.web.shelf import ASKED_FOR, Shelf, file
from services.web.words import read

HERE = Path(__file__).parent
ASSETS = HERE / "assets"
PARTICIPANT, CONSOLE, NUMBER = "participant", "console", "number"

_SHEETS = ("base", "light", "study", "form", "participant", "console", "contrast")
_STYLE = "study.css"


@cache
def spoken() -> dict[str, dict[str, str]]:
    """All words, by language and name; what a language has no word for is English."""
    tables = {path.stem: read(path) for path in sorted(words.FOLDER.glob("*.toml"))}
    return {language: {**tables["en"], **table} for language, table in tables.items()}


def document(page: str, **facts: str) -> str:
    """A page's HTML.

    Args:
        page: `PARTICIPANT`, `CONSOLE` or `NUMBER`.
        facts: what stands in it.
    """
    said: Mapping[str, str] = spoken()["en"]
    made = {
        "version": version(),
        "words": msgspec.json.encode(spoken()).decode().replace("<", "\\u003c"),
        "page": page,
        "number": "",
        "name": escape(said["page.name"]),
        "number_label": escape(said["number.label"]),
        "number_open": escape(said["number.open"]),
        **{name: escape(fact) for name, fact in facts.items()},
    }
    frame = page if page == NUMBER else "tab"  # all that a script fills has one frame
    return Template((HERE / f"{frame}.html").read_text(encoding="utf-8")).substitute(made)


@cache
def version() -> str:
    """Changes with the pages' files: a tab that was loaded from others loads itself anew."""
    folders = (ASSETS, look.FOLDER, words.FOLDER)
    files = sorted(path for folder in folders for path in folder.rglob("*.*") if path.suffix not in (".py", ".pyc"))
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()[:12]


def asset_files() -> Shelf:
    """What the pages load, by its address below /assets/."""
    scripts = {path.relative_to(ASSETS).as_posix(): path for path in ASSETS.rglob("*.js")}
    pictures = {path.name: path for path in look.FOLDER.glob("*.svg")}
    files = {address: file("text/javascript", path.read_bytes()) for address, path in scripts.items()}
    files |= {address: file("image/svg+xml", path.read_bytes()) for address, path in pictures.items()}
    return Shelf({**files, _STYLE: file("text/css", joined(_SHEETS, ASSETS / "css").encode())}, ASKED_FOR)
