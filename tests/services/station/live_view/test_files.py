"""What the live view loads: three.js as it is published, all of it small, kept by browsers."""

import gzip
import hashlib
from importlib.metadata import PackageNotFoundError

import pytest

from services.station.live_view import files
from services.station.live_view.description import describe, described
from services.station.live_view.files import LIBRARY_VERSION, Files, library
from services.station.page.asset_files import ASSETS, asset_files
from services.station.page.document import document
from sim.tasks import DISHWASHER
from sim.tasks.scene import Eye
from tests.services.station.browser import ask

NOTHING = described((), {}, Eye(), None)

# Of the package three 0.180.0 on the npm registry; OrbitControls.js with './three.module.min.js' for 'three'.
PUBLISHED = {
    "three.module.min.js": "e2b5ee6bccd38fd6d8a2428546b83c5f2426d84b152ef82be8055556e3b40eb6",
    "three.core.min.js": "61ba0df005b05991361d040d8ff670e1aadfd0ce7aeebd1fdb0725957a8957de",
    "OrbitControls.js": "6c860c6b342200f8aef65493319c12bfb2d652107355b1d25eb2154371128391",
}


def test_the_library_is_what_its_authors_published():
    assert {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in library()} == PUBLISHED


def test_the_scripts_name_the_library_by_the_address_under_which_it_is_served():
    script = (ASSETS / "js" / "drawing" / "three.js").read_text()
    served = Files(NOTHING)
    for name in ("three.module.min.js", "OrbitControls.js"):
        assert f'"/view/three-{LIBRARY_VERSION}/{name}"' in script
        answer = ask(served, f"three-{LIBRARY_VERSION}/{name}")
        assert answer.headers["content-type"].startswith("text/javascript")
        assert hashlib.sha256(gzip.decompress(answer.body)).hexdigest() == PUBLISHED[name]


def test_a_browser_keeps_what_it_has_loaded():
    served = Files(NOTHING)
    answer = ask(served, served.description_address.removeprefix("/view/"))
    assert answer.status_code == 200
    assert "immutable" in answer.headers["cache-control"]
    assert answer.headers["content-encoding"] == "gzip"
    assert gzip.decompress(answer.body) == NOTHING.words


def test_another_description_has_another_address():
    other = described((), {}, Eye((1.0, 1.0, 1.0)), None)
    assert Files(NOTHING).description_address != Files(other).description_address


@pytest.mark.parametrize("path", ["", "three.module.min.js", f"three-{LIBRARY_VERSION}/../LICENSE.three.txt"])
def test_no_other_file_is_served(path):
    assert ask(Files(NOTHING), path).status_code == 404


@pytest.mark.sim
def test_a_page_loads_less_than_three_megabytes():
    served = Files(describe(DISHWASHER))
    page = document("robot1", served).encode()
    assert served.size + asset_files().size + len(page) < 0.6e6


def test_without_the_library_the_page_is_served_and_the_log_says_what_to_do(monkeypatch, caplog):
    def missing(name):
        raise PackageNotFoundError(name)

    monkeypatch.setattr(files, "distribution", missing)
    served = Files(NOTHING)
    assert ask(served, f"three-{LIBRARY_VERSION}/three.module.min.js").status_code == 404
    assert "deploy/setup" in caplog.text
