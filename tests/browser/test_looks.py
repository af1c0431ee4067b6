"""How the main states look: regions where they belong, none of them empty. They are pictured for the documentation by

deploy/test tests/browser/test_looks.py --pictures deploy/pictures/states

and looked at again in every test run: what became another picture has to be pictured anew, and seen to be right.
"""

from dataclasses import replace
from pathlib import Path

import cv2
import msgspec
import numpy as np
import pytest
from states import states

from protocol.messages import Method, Recording, Waypoint
from services.accounts.file import AccountsFile
from services.station.page.login.judge import Judge
from tests.ports import free_port

pytestmark = pytest.mark.browser

STATES = states()
TOLERANCE = 0.05
"""Share of the window by which a region may be elsewhere: other fonts, another word."""

REGIONS = {
    ".header": (0.0, 0.0, 1.0, 0.06),
    ".scene": (0.0, 0.05, 0.64, 0.70),
    ".timeline": (0.0, 0.71, 0.64, 0.79),
    ".pad": (0.0, 0.79, 0.64, 1.0),
    ".guide": (0.65, None, 1.0, None),
    ".verdict": (0.65, None, 1.0, None),
    ".history": (0.65, None, 1.0, None),
    ".stop": (0.65, None, 1.0, 1.0),
}
"""Left, top, right and bottom as shares of a window of 1600 x 900; None where it depends on what is said."""

PICTURE = (1280, 720)
PICTURES = Path(__file__).parents[2] / "deploy" / "pictures" / "states"
LOGIN = "login.jpg"
QUALITY = 60
SQUARE, NOTICED, AT_MOST = 16, 24, 0.03
"""Pictures are compared by squares of so many pixels, which differ by so much of 255; and of how many may."""

CUT = """() => [...document.querySelectorAll(".entry, .waypoint, .criterion, .confidence")].filter((row) => {
    const { top, bottom } = row.getBoundingClientRect();
    const ends = [row.parentElement, document.querySelector(".side")].map((e) => e.getBoundingClientRect().bottom);
    return top < Math.min(...ends) - 1 && bottom > Math.min(...ends) + 1;
}).map((row) => row.textContent)"""
"""The rows that are seen by half."""

COVERED = """() => {
    const boxes = (selector) => [...document.querySelectorAll(selector)].filter((element) => element.checkVisibility())
        .map((element) => [element.className, element.getBoundingClientRect()]);
    const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
    const others = [...boxes(".legend"), ...boxes(".scene-tools > *"), ...boxes(".camera")];
    const over = [...boxes(".scene-fault"), ...boxes(".scene-stale")];
    return [...over, ...boxes(".legend")].flatMap(([name, box]) => others
        .filter(([other, its]) => other !== name && meet(box, its)).map(([other]) => `${name} lies over ${other}`));
}"""

LOOKS = 6
AT_LEAST_SENT = 3
"""So often the cameras' pictures are sent, as new ones each time: one that is old is grey."""

COLOURS = {"red": (229, 72, 77), "amber": (240, 180, 41), "hold": (185, 163, 255), "green": (46, 194, 126)}


def show(tab, feed, view):
    """Show a view, until its sentence is there."""
    feed.view = view
    words = view.teaching.text if view.teaching is not None else "The station is starting."
    tab.wait(f'.light-text:text-is("{words}")')


def seen(tab, selector):
    """A region as it is seen, shape (height, width, 3), red first."""
    image = cv2.imdecode(np.frombuffer(tab.page.locator(selector).first.screenshot(), np.uint8), cv2.IMREAD_COLOR)
    return cv2.cvtColor(image, cv2.COLOR_BGR2RGB).astype(int)


@pytest.mark.parametrize("name", STATES)
def test_every_region_is_where_it_belongs_in_every_state(viewed, station, name):
    show(viewed, station[1], STATES[name])
    boxes = {region: viewed.page.locator(region).first.bounding_box() for region in REGIONS}
    sides = {
        region: (box["x"] / 1600, box["y"] / 900, (box["x"] + box["width"]) / 1600, (box["y"] + box["height"]) / 900)
        for region, box in boxes.items()
    }
    moved = {
        region: (sides[region], wanted)
        for region, wanted in REGIONS.items()
        if any(w is not None and abs(s - w) > TOLERANCE for s, w in zip(sides[region], wanted, strict=True))
    }
    assert moved == {}


@pytest.mark.parametrize("scheme", ["dark", "light"])
def test_no_region_is_empty(viewed, station, scheme):
    viewed.page.emulate_media(color_scheme=scheme)
    show(viewed, station[1], STATES["failed"])
    flat = [region for region in REGIONS if seen(viewed, region).std() < 5.0]
    assert flat == []


@pytest.mark.parametrize(
    ("name", "light"), [("alone", "red"), ("learning", "amber"), ("paused", "hold"), ("correcting", "green")]
)
def test_the_light_is_seen_in_its_colour_and_no_other_is(viewed, station, name, light):
    show(viewed, station[1], STATES[name])
    lamps = seen(viewed, ".lamps")
    shares = {colour: np.mean(np.all(np.abs(lamps - np.array(rgb)) < 12, axis=2)) for colour, rgb in COLOURS.items()}
    assert shares[light] > 0.02
    assert all(share < 0.002 for colour, share in shares.items() if colour != light)


@pytest.mark.parametrize("size", [(1920, 1080), (1600, 900), (1366, 768)])
@pytest.mark.parametrize("method", [Method.REFINE, Method.WAYPOINTS])
def test_no_row_is_cut_through_and_nothing_lies_over_legend_or_buttons(viewed, station, size, method):
    viewed.page.set_viewport_size({"width": size[0], "height": size[1]})
    view = STATES["failed"]
    here = tuple(Waypoint((0.5 + 0.05 * n, 0.0, 0.6), (1.0, 0.0, 0.0, 0.0)) for n in range(9))
    fault = Recording(
        path="/r", viewer_url="", recording_id="r", fault="Nothing is recorded: " + "the disk is full. " * 6
    )
    teaching = msgspec.structs.replace(view.teaching, method=method, waypoints=here, text=f"{method.value} {size}")
    show(viewed, station[1], replace(view, teaching=teaching, recording=fault))
    viewed.wait(".scene-fault:has-text('the disk is full')")
    assert viewed.page.evaluate(CUT) == []
    assert viewed.page.evaluate(COVERED) == []


@pytest.fixture(scope="session")
def scenery():
    """What the robot's cameras see of the scene, as JPEG: head and wrist."""
    pytest.importorskip("mujoco")
    from harness import OBJECT, Picture

    from sim.robots.description import prepare
    from sim.tasks import DISHWASHER
    from sim.world.cameras import Cameras
    from sim.world.physics import World

    variant, description = DISHWASHER.variants[1], prepare()
    world = World(DISHWASHER, variant, description)
    world.reset(np.array(OBJECT.position))
    cameras = Cameras(DISHWASHER, description)
    cameras.show(variant)
    drawn = [cameras.render(name, world.state) for name in ("head", "wrist")]
    cameras.close()
    encoded = [cv2.imencode(".jpg", cv2.cvtColor(image, cv2.COLOR_RGB2BGR))[1].tobytes() for image in drawn]
    return {name: Picture(jpeg, 0.02) for name, jpeg in zip(("head", "wrist"), encoded, strict=True)}


@pytest.mark.parametrize("name", STATES)
def test_every_state_looks_as_it_is_pictured(request, viewed, station, tmp_path, name):
    """Or is pictured for the documentation. How it looks in detail is for people to judge."""
    folder = request.config.getoption("--pictures", default=None)
    viewed.page.set_viewport_size({"width": PICTURE[0], "height": PICTURE[1]})
    show(viewed, station[1], STATES[name])
    if folder is not None:
        draw(viewed, station[1], STATES[name], request.getfixturevalue("scenery"))
        Path(folder).mkdir(parents=True, exist_ok=True)
        viewed.page.screenshot(path=Path(folder) / f"{name}.jpg", type="jpeg", quality=QUALITY)
        return
    now, then = settled(viewed), cv2.imread(str(PICTURES / f"{name}.jpg"))
    differs = difference(now, then, viewed.page.locator(".scene").bounding_box())
    if differs.mean() > AT_MOST:
        shown = tmp_path / f"{name}.png"
        marks = cv2.resize(differs.astype(np.uint8) * 255, PICTURE, interpolation=cv2.INTER_NEAREST)
        cv2.imwrite(str(shown), cv2.vconcat([then, now, cv2.cvtColor(marks, cv2.COLOR_GRAY2BGR)]))
        pytest.fail(f"{differs.mean():.1%} of the page looks otherwise: as it was, as it is, and where in {shown}")


@pytest.fixture
def way_in(window, tmp_path):
    """The log-in, of a page where nobody has an account."""
    from harness import served

    judge = Judge(AccountsFile(tmp_path / "accounts.json"), lambda *_: False)
    with served(judge=judge, port=free_port()) as (page, _):
        tab = window.new_page()
        tab.set_viewport_size({"width": PICTURE[0], "height": PICTURE[1]})
        tab.goto(page.url)
        yield tab
        tab.close()


def test_the_log_in_looks_as_it_is_pictured(request, way_in, tmp_path):
    folder = request.config.getoption("--pictures", default=None)
    shown = tmp_path / LOGIN if folder is None else Path(folder) / LOGIN
    way_in.screenshot(path=shown, type="jpeg", quality=QUALITY)
    now, then = (cv2.imread(str(picture)) for picture in (shown, PICTURES / LOGIN))
    assert difference(now, then, dict.fromkeys(("x", "y", "width", "height"), 0)).mean() <= AT_MOST, shown


def draw(tab, feed, view, scenery):
    """Let everything be drawn as finely as it can be."""
    tab.wait(".scene[data-view=live]")
    tab.page.wait_for_timeout(1500)  # the view is drawn finer once nothing changes
    for _ in range(AT_LEAST_SENT if view.cameras else 0):
        sent = {camera: replace(picture, data=bytes(bytearray(picture.data))) for camera, picture in scenery.items()}
        feed.view = replace(view, cameras=sent)
        tab.page.wait_for_timeout(200)


def settled(tab):
    """The page once it moves no more, as OpenCV has pictures."""
    before = None
    for _ in range(LOOKS):
        now = tab.page.screenshot(mask=[tab.page.locator(".scene")], animations="disabled")
        if now == before:
            break
        before = now
    return cv2.imdecode(np.frombuffer(now, np.uint8), cv2.IMREAD_COLOR)


def difference(now, then, scene):
    """Which squares of two pictures differ, but for the scene: what is drawn there, no two machines draw alike."""
    boxes = [int(scene[side]) for side in ("x", "y", "width", "height")]
    squares = []
    for picture in (now, then):
        known = picture.copy()
        cv2.rectangle(known, boxes, (0, 0, 0), cv2.FILLED)
        size = PICTURE[0] // SQUARE, PICTURE[1] // SQUARE
        squares.append(cv2.resize(known, size, interpolation=cv2.INTER_AREA).astype(int))
    return np.abs(squares[0] - squares[1]).max(axis=2) > NOTICED
