"""What the tests of this folder share: a page where people log in, and a browser that has come to it."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture
def open_house(tmp_path):
    from house import house

    with house(tmp_path) as opened:
        yield opened


@pytest.fixture
def browser(open_house):
    from house import Browser

    return Browser(open_house.page)


@pytest.fixture
def inside(browser):
    """A browser whose person has logged in."""
    assert browser.log_in().status == 303
    return browser
