"""What the study's pages load and say is there, in every language."""

import gzip
import re

import pytest

from services.study import words
from services.study.page.document import ASSETS, CONSOLE, PARTICIPANT, asset_files, document, spoken
from services.web.words import read
from tests.services.station.browser import ask

SCRIPTS = {path: path.read_text(encoding="utf-8") for path in ASSETS.rglob("*.js")}
TABLES = {path.stem: read(path) for path in words.FOLDER.glob("*.toml")}

MADE = {
    "part": ("consent", "training", "model", "rest"),
    "state": (
        "ready",
        "form",
        "runs",
        "rest",
        "paused",
        "interrupted",
        "finished",
        "gone",
        "withdrawn",
        "deleted",
        "open",
        "begun",
        "passed",
        "failed",
        "invalid",
    ),
    "end": ("finished", "withdrawn", "deleted", "gone"),
    "wait": ("paused", "old", "busy", "starting"),
    "kind": ("note", "pause", "go_on", "invalid", "gone", "withdrawn", "deviation"),
    "attempt": ("alone", "prediction", "refinement", "waypoints", "demonstration", "missed", "kicked", "collision"),
}
"""Words whose names the scripts put together."""


def test_all_languages_say_the_same_things_with_the_same_facts():
    facts = {
        tag: {key: set(re.findall(r"\{(\w+)\}", text)) for key, text in table.items()} for tag, table in TABLES.items()
    }
    assert facts["de"] == facts["nl"] == facts["en"]


def test_every_word_that_a_script_says_is_there():
    said = {key for text in SCRIPTS.values() for key in re.findall(r"say\(\s*\"(\w+\.\w+)\"", text)}
    made = {f"{section}.{name}" for section, names in MADE.items() for name in names}
    assert len(said) > 50
    assert said | made <= set(TABLES["en"])


def test_every_script_that_is_imported_is_served():
    served = asset_files()
    wanted = {path for text in SCRIPTS.values() for path in re.findall(r'from "/assets/([\w/.]+)"', text)}
    assert all(ask(served, path).status_code == 200 for path in wanted | {"study.css", "retouch.svg", "symbols.svg"})


def test_every_sheet_is_in_the_one_that_is_loaded():
    style = gzip.decompress(ask(asset_files(), "study.css").body).decode()
    assert all(sheet.read_text(encoding="utf-8") in style for sheet in (ASSETS / "css").glob("*.css"))


@pytest.mark.parametrize(("page", "facts"), [(PARTICIPANT, {"number": "1"}), (CONSOLE, {})])
def test_nothing_in_the_words_ends_the_element_that_holds_them(page, facts):
    held = document(page, **facts).partition('id="words">')[2].partition("</script>")[0]
    assert "<" not in held
    assert set(spoken()) == {"en", "de", "nl"}
