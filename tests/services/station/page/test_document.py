"""The page that is loaded, and what is told to it."""

import gzip
import re
from dataclasses import replace

from views import SEATED, shown

from services.station.page.asset_files import ASSETS, asset_files
from services.station.page.document import document, version
from services.station.page.layout import own, shared
from services.station.page.seating import seating
from services.station.page.values import Sent
from services.web import look
from tests.services.station.browser import VIEW, ask

PAGE = document("robot1", VIEW)


def test_every_value_has_one_element_that_shows_it():
    names = re.findall(r'data-value="([a-z0-9_-]+)"', PAGE)
    assert len(names) == len(set(names))
    assert {name.partition("@")[0] for name in {**shared(shown()), **own(shown(), SEATED)}} <= set(names)


def test_a_name_stands_in_it_as_text():
    assert "<title>Retouch: &lt;b&gt;</title>" in document("<b>", VIEW)


def test_nothing_in_it_is_run_or_styled_from_within():
    assert not re.search(r"<style| style=| on[a-z]+=", PAGE)
    assert re.findall(r"<script ([^>]*)>", PAGE) == [
        'type="application/json" id="words"',
        'type="module" src="/assets/js/station.js"',
    ]


def test_it_names_all_that_is_loaded_at_once_and_each_is_served():
    loaded = re.findall(r'<link rel="(?:modulepreload|preload|stylesheet)"[^>]* href="([^"]+)"', PAGE)
    scripts = {f"/assets/{path.relative_to(ASSETS).as_posix()}" for path in ASSETS.rglob("*.js")}
    assert scripts <= set(loaded)
    shelves = {"assets": asset_files(), "view": VIEW}
    for address in loaded:
        _, shelf, path = address.split("/", 2)
        assert ask(shelves[shelf], path).status_code == 200


def test_every_sheet_is_in_the_one_that_is_loaded():
    style, login = (gzip.decompress(ask(asset_files(), f"{name}.css").body).decode() for name in ("station", "login"))
    for sheet in [*(ASSETS / "css").glob("*.css"), *look.FOLDER.glob("*.css")]:
        assert sheet.read_text() in (login if sheet.stem == "login" else style)


def test_it_names_the_version_of_its_files():
    assert f'data-version="{version()}"' in PAGE


def test_a_tab_is_told_what_is_new_to_it():
    sent = Sent()
    assert sent.news({"a": "1", "b": True}) == {"a": "1", "b": True}
    assert sent.news({"a": "1", "b": False}) == {"b": False}
    assert sent.news({"a": "2"}) == {"a": "2"}
    assert sent.news({"c": None}) == {"c": None}


def test_a_tab_says_why_its_keys_do_not_count():
    assert seating(SEATED)["let-go"] == ""
    assert "Let go of all keys" in seating(replace(SEATED, let_go=True))["let-go"]
    assert "Click into the page" in seating(replace(SEATED, let_go=True, focused=False))["let-go"]
    late = seating(replace(SEATED, let_go=True, heard=False, focused=False))["let-go"]
    assert "come too late" in late
    assert "Click into the page" not in late
    assert seating(replace(SEATED, let_go=True, armed=False))["let-go"] == ""


def test_whoever_is_asked_for_the_seat_is_told_how_long_it_is_kept():
    asked = seating(replace(SEATED, asked_s=3.2))
    assert (asked["asked@data-open"], "in 4 s" in asked["asked-text"]) == (True, True)
    assert seating(SEATED)["asked@data-open"] is False


def test_whoever_asks_for_the_seat_is_told_what_becomes_of_it():
    assert "in 4 s" in seating(replace(SEATED, armed=False, asking_s=3.2))["view-only-text"]
    assert "keeps it" in seating(replace(SEATED, armed=False, kept=True))["view-only-text"]
    assert "only stop" in seating(replace(SEATED, armed=False))["view-only-text"]
