"""The page's own 3-D view: what a person sees in it, what it costs, and what is said where it cannot be."""

from dataclasses import replace

import cv2
import msgspec
import numpy as np
import pytest

from protocol.messages import Mode
from services.station.live_view.drawing import Drawing

pytestmark = pytest.mark.browser

PREDICTED, REFINED = (230, 159, 0), (86, 180, 233)
NO_WEBGL = """
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind.startsWith("webgl") ? null : get.call(this, kind, ...rest);
    };
"""


@pytest.fixture
def seen(tab):
    """A function that gives the live view's picture as it is now, shape (height, width, 3), red first."""
    tab.wait(".scene[data-view=live]")
    # The legend has these colours too, and what cameras show grows old meanwhile.
    hide = "document.querySelectorAll('.legend, .camera').forEach((over) => { over.style.visibility = 'hidden'; })"
    tab.page.evaluate(hide)

    def look():
        picture = cv2.imdecode(np.frombuffer(tab.page.locator(".view").screenshot(), np.uint8), cv2.IMREAD_COLOR)
        return cv2.cvtColor(picture, cv2.COLOR_BGR2RGB).astype(int)

    return look


@pytest.fixture
def becomes(tab, eventually):
    """A function that waits until a condition holds, and lets the browser live meanwhile."""
    return lambda condition: eventually(lambda: condition() or tab.page.wait_for_timeout(50))


def share(picture, colour):
    """Share of the picture that has a colour."""
    return np.mean(np.all(np.abs(picture - np.array(colour)) < 12, axis=2))


def test_prediction_and_refinement_are_seen_in_their_colours_and_go_when_there_are_none(seen, station, becomes):
    _, feed = station
    becomes(lambda: share(seen(), PREDICTED) > 1e-4 and share(seen(), REFINED) > 1e-4)
    feed.view = replace(feed.view, drawing=msgspec.structs.replace(feed.view.drawing, prediction=None, way=()))
    becomes(lambda: share(seen(), PREDICTED) == 0.0)


def test_the_robot_is_where_its_joints_are(seen, station, becomes):
    _, feed = station
    becomes(lambda: share(seen(), PREDICTED) > 1e-4)
    before = seen()
    torso, shoulder, *others = feed.view.robot.q
    feed.view = replace(feed.view, robot=msgspec.structs.replace(feed.view.robot, q=(torso, shoulder + 0.6, *others)))
    becomes(lambda: np.mean(np.any(np.abs(seen() - before) > 30, axis=2)) > 0.01)


def test_an_empty_room_is_drawn_too(seen, station, becomes):
    _, feed = station
    feed.view = replace(feed.view, robot=None, object_pose=None, drawing=Drawing())
    becomes(lambda: share(seen(), PREDICTED) == share(seen(), REFINED) == 0.0)
    assert seen().std() > 5.0


def test_it_turns_with_the_pointer_and_back_and_the_keys_stay_the_operators(tab, seen, hand, becomes):
    becomes(lambda: share(seen(), PREDICTED) > 1e-4)
    looks = [seen()]
    becomes(lambda: looks.append(seen()) or np.mean(np.abs(looks[-1] - looks[-2])) < 0.1)  # all of it has come
    before = looks[-1]
    box = tab.page.locator(".view").bounding_box()
    tab.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    tab.page.mouse.down()
    tab.page.mouse.move(box["x"] + box["width"] / 2 + 150, box["y"] + box["height"] / 2 + 40, steps=4)
    tab.page.mouse.up()
    becomes(lambda: np.mean(np.abs(seen() - before)) > 3.0)
    hand.hold("KeyW")
    hand.let_go()
    tab.page.click(".scene-home")
    becomes(lambda: np.mean(np.abs(seen() - before)) < 1.0)
    hand.hold("KeyE")
    hand.let_go()


def test_the_links_are_where_pinocchio_has_them(tab):
    pinocchio = pytest.importorskip("pinocchio")
    from sim.robots.description import prepare

    model = pinocchio.buildModelFromUrdf(str(prepare().urdf))
    q = np.random.default_rng(7).uniform(model.lowerPositionLimit, model.upperPositionLimit)
    data = model.createData()
    pinocchio.framesForwardKinematics(model, data, q)
    values = {model.names[i]: q[model.joints[i].idx_q] for i in range(1, model.njoints)}
    matrices = tab.page.evaluate(
        """async (values) => {
            const { Robot } = await import("/assets/js/drawing/robot.js");
            const words = new URL(document.querySelector(".view").dataset.description, location);
            const description = await (await fetch(words)).json();
            const shapes = await (await fetch(new URL("shapes.bin", words))).arrayBuffer();
            const robot = new Robot(description, shapes);
            robot.move(description.joints.map((joint) => values[joint]));
            robot.root.updateMatrixWorld(true);
            return Object.fromEntries(robot.links.map(({ name, matrixWorld }) => [name, matrixWorld.elements]));
        }""",
        values,
    )
    assert len(matrices) > 40
    for name, elements in matrices.items():
        frame = data.oMf[model.getFrameId(name, pinocchio.BODY)]
        np.testing.assert_allclose(np.reshape(elements, (4, 4)).T, frame.homogeneous, atol=1e-6)


def test_a_tube_is_as_wide_in_every_direction_as_the_ellipsoid_there(tab):
    positions = tab.page.evaluate(
        """async () => {
            const { ellipsoid, sweep } = await import("/assets/js/drawing/sweep.js");
            const points = [[0, 0, 0], [0, 0, 0], [1, 0, 0], [2, 0, 0]];
            return sweep(points, (i, direction) => ellipsoid([0.1, 0.2, 0.4], direction), 16).positions;
        }"""
    )
    rings = np.reshape(positions, (-1, 16, 3))
    assert len(rings) == 3  # a point that is said twice is one
    np.testing.assert_allclose(rings.max(axis=1) - rings.mean(axis=1), [[0.0, 0.2, 0.4]] * 3, atol=1e-9)


def test_it_rests_twice_as_long_as_a_picture_took_and_draws_coarser_where_it_is_slow(tab):
    waits, finenesses = tab.page.evaluate(
        """async () => {
            const { Cadence } = await import("/assets/js/drawing/cadence.js");
            const [fast, slow] = [new Cadence(), new Cadence()];
            fast.begin(1000);
            fast.done(1004);
            const finenesses = [];
            for (let now = 0; now < 12000; now += 1000) {
                slow.begin(now);
                slow.done(now + 200);
                finenesses.push(slow.fineness);
            }
            return [[fast.wait(1004), slow.wait(11200)], finenesses];
        }"""
    )
    assert waits == pytest.approx([1000 / 30 - 4, 400.0])
    assert (finenesses[0], finenesses[-1]) == (1, 0.5)


def test_nothing_is_drawn_where_nothing_changes(tab, seen, station, becomes):
    """A picture is drawn once all is there, and then no more."""
    drawn = "performance.getEntriesByName('drawn').length"
    tab.page.evaluate(
        """() => {
            const draw = WebGL2RenderingContext.prototype.fenceSync;
            WebGL2RenderingContext.prototype.fenceSync = function (...rest) {
                performance.mark("drawn");
                return draw.apply(this, rest);
            };
        }"""
    )

    def is_quiet():
        before = tab.page.evaluate(drawn)
        tab.page.wait_for_timeout(500)
        return tab.page.evaluate(drawn) == before

    becomes(is_quiet)
    before = tab.page.evaluate(drawn)
    station[1].moving_robot = True
    becomes(lambda: tab.page.evaluate(drawn) > before + 3)
    station[1].moving_robot = False


def test_the_page_loads_less_than_three_megabytes_and_nothing_of_the_viewers(open_tab, station):
    loaded = {}

    def note(response):
        loaded[response.url] = response.request.sizes()["responseBodySize"]

    tab = open_tab("about:blank")
    tab.page.on("response", note)
    tab.page.goto(station[0].url)
    tab.wait(".scene[data-view=live]")
    assert any("three.core" in url for url in loaded)
    assert sum(loaded.values()) < 0.6e6
    assert {url.split("/")[2] for url in loaded} == {station[0].url.split("/")[2]}


def test_a_browser_that_cannot_draw_says_so_and_all_else_goes_on(open_seated, station):
    tab = open_seated(script=NO_WEBGL)
    tab.wait(".scene-empty:visible:has-text('WebGL 2')")
    tab.wait("[data-camera=head][data-state=live], [data-camera=head][data-state=stale]")
    tab.page.keyboard.down("KeyW")
    tab.wait("[data-key=KeyW][data-held]")
    tab.page.keyboard.up("KeyW")
    assert tab.faults == []


def test_where_its_files_do_not_come_it_says_so_and_all_else_goes_on(open_tab, calm_station):
    tab = open_tab("about:blank")
    tab.page.route("**/view/**", lambda route: route.abort())
    tab.page.goto(calm_station[0].url)
    tab.wait(".scene-empty:visible:has-text('Load the page anew')")
    tab.wait("body:not([data-link=offline])")


def test_a_drawing_that_the_browser_takes_away_is_said_to_be_gone_and_comes_back(tab, seen, becomes):
    becomes(lambda: share(seen(), PREDICTED) > 1e-4)
    tab.page.evaluate("""() => {
        window.taken = document.querySelector(".view").getContext("webgl2").getExtension("WEBGL_lose_context");
        window.taken.loseContext();
    }""")
    tab.wait(".scene-empty:visible:has-text('taken the drawing away')")
    tab.page.evaluate("window.taken.restoreContext()")
    tab.wait(".scene[data-view=live]")
    becomes(lambda: share(seen(), PREDICTED) > 1e-4)


def test_a_lost_link_loads_nothing_anew(open_seated, station, cable):
    _, feed = station
    tab = open_seated(cable.url)
    tab.wait(".scene[data-view=live]")
    tab.page.evaluate("window.loadedOnce = true")
    for lost in (True, False):
        cable.cut()
        tab.wait("body[data-link=offline]")
        cable.mend(lost=lost)
        tab.wait("body[data-link=armed]")
    feed.view = replace(feed.view, notice="the link is back")
    tab.wait(".notice:text-is('the link is back')")
    assert tab.page.evaluate("window.loadedOnce")
    assert sum("three.module" in url for url in tab.requests) == 1


def test_the_force_of_a_device_without_one_is_a_bar_with_a_number(tab, station):
    _, feed = station
    tab.wait(".force:visible:has-text('2.5 N')")
    feed.view = replace(feed.view, force=(3.0, 0.0, 4.0))
    tab.wait(".force[aria-valuenow='5.0']:visible:has-text('5.0 N')")
    feed.view = replace(feed.view, robot=msgspec.structs.replace(feed.view.robot, mode=Mode.AUTONOMOUS))
    tab.wait(".force", state="hidden")
    tab.wait(".legend-way:has-text('travelled')")
