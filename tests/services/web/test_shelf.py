"""Files in memory: what a browser has already is not sent again."""

import gzip

import pytest

from services.web.shelf import ASKED_FOR, KEPT, Shelf, file
from tests.services.station.browser import ask

SHELF = Shelf({"a.js": file("text/javascript", b"let a;")}, ASKED_FOR)


def test_a_file_is_sent_compressed():
    answer = ask(SHELF, "a.js")
    assert answer.headers["content-type"].startswith("text/javascript")
    assert gzip.decompress(answer.body) == b"let a;"


def test_what_a_browser_has_is_not_sent_again():
    tag = ask(SHELF, "a.js").headers["etag"]
    answer = ask(SHELF, "a.js", If_None_Match=tag)
    assert (answer.status_code, answer.body) == (304, b"")
    changed = Shelf({"a.js": file("text/javascript", b"let b;")}, ASKED_FOR)
    assert ask(changed, "a.js", If_None_Match=tag).status_code == 200


@pytest.mark.parametrize("caching", [ASKED_FOR, KEPT])
def test_how_long_it_may_be_kept_is_said(caching):
    assert ask(Shelf({"a": file("text/plain", b"")}, caching), "a").headers["cache-control"] == caching


@pytest.mark.parametrize("path", ["", "b.js", "../a.js"])
def test_nothing_else_is_served(path):
    assert ask(SHELF, path).status_code == 404
