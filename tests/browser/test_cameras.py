"""However many cameras there are, each has a place of its own on the page; one that is pressed becomes large."""

import itertools
from dataclasses import replace

import pytest
from harness import Picture, picture, served

from tests.ports import free_port

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

CAMERAS = ("head", "wrist", "side", "above", "left", "right")


def overlap(one, other):
    """Whether two boxes on the page have a place in common."""
    return all(
        one[at] < other[at] + other[size] and other[at] < one[at] + one[size]
        for at, size in (("x", "width"), ("y", "height"))
    )


@pytest.fixture(scope="module")
def many():
    with served(port=free_port(), cameras=CAMERAS) as (page, feed):
        feed.view = replace(feed.view, cameras={name: Picture(picture(name), 0.02) for name in CAMERAS})
        yield page


def test_each_camera_shows_its_picture_in_a_place_of_its_own_and_any_becomes_large(many, open_tab):
    tab = open_tab(many.url)
    for name in CAMERAS:
        tab.wait(f"[data-camera={name}][data-state=live], [data-camera={name}][data-state=stale]")
    drawn = {
        tab.page.evaluate(f"document.querySelector('[data-camera={name}] canvas').toDataURL()") for name in CAMERAS
    }
    assert len(drawn) == len(CAMERAS)
    for large in ("side", "above", "head"):
        tab.page.click(f"[data-swap={large}]")
        tab.wait(f".scene[data-main={large}]")
        boxes = {name: tab.page.locator(f"[data-stage={name}]").bounding_box() for name in ("live", *CAMERAS)}
        assert boxes.pop(large)["width"] > 2 * max(box["width"] for box in boxes.values())
        scene = tab.page.locator(".scene").bounding_box()
        assert all(scene["y"] < box["y"] for box in boxes.values())
        assert not any(overlap(*pair) for pair in itertools.combinations(boxes.values(), 2))
    assert not tab.faults
