"""The page's link, as a browser has it: what is drawn slowly is sent less often, and nothing piles up."""

import json
import time
from dataclasses import replace

import msgspec
import pytest
from websockets.sync.client import connect

from protocol.messages import Coding, Phase, Pose, RobotState
from services.bus.picture_stream import Group
from services.process.clock import SystemClock
from services.process.config import StationSection
from services.station.live_view.description import described
from services.station.live_view.drawing import Drawing
from services.station.page.link import CLOUD, FIRST_CAMERA, FRAME_HEADER, FROM_KEY, GOES_ON, LENGTH, MOMENT, WHOLE
from services.station.page.page import Page
from services.station.page.said import Held, Hello
from services.station.page.view import PageView, Picture
from sim.tasks.scene import Eye
from tests.ports import free_port

pytestmark = pytest.mark.sim  # in real time

UPRIGHT = (1.0, 0.0, 0.0, 0.0)


class Browser:
    """A page that is loaded, and says which moments it has drawn.

    Args:
        socket: to the station.
    """

    def __init__(self, socket):
        self._socket = socket
        self._socket.send(msgspec.json.encode(Hello("seat-0001", "load-0001")).decode())
        self._said = 0
        self.drawing = {}
        self.pictures = []

    def hear(self, seconds, *, drawing=True, kind=MOMENT):
        """The numbers of the moments that come within this time, or of what else is asked for."""
        numbers, until = [], time.monotonic() + seconds
        while (left := until - time.monotonic()) > 0.0:
            try:
                frame = self._socket.recv(timeout=left)
            except TimeoutError:
                break
            if isinstance(frame, str):
                self.drawing.update(json.loads(frame)["drawing"])
                continue
            came, coding, number, _ = FRAME_HEADER.unpack_from(frame)
            if came == FIRST_CAMERA:
                self.pictures.append((coding, split(frame[FRAME_HEADER.size :]) if coding else frame[-1:]))
            if came == kind:
                numbers.append(number)
            if drawing and came == MOMENT:
                self.say(moment=number)
        return numbers

    def say(self, *, head=0, moment=0, cloud=False, clouds=0, jpeg_only=False):
        """What it has drawn, whether it shows the point cloud, and whether it draws no H.264."""
        self._said += 1
        drawn = moment, clouds, head, 0
        held = Held(self._said, time.monotonic() * 1e3, (), True, True, (), drawn, cloud, jpeg_only)
        self._socket.send(msgspec.json.encode(held).decode())


def split(content):
    """The pictures of a frame of H.264."""
    pictures = []
    while content:
        (length,) = LENGTH.unpack_from(content)
        pictures.append(content[LENGTH.size :][:length])
        content = content[LENGTH.size + length :]
    return pictures


@pytest.fixture
def page():
    served = Page(StationSection(port=free_port()), "robot1", SystemClock(), described((), {}, Eye(), None))
    served.start()
    yield served
    served.close()


@pytest.fixture
def browser(page):
    with connect(f"{page.url.replace('http', 'ws')}/link", origin=page.url) as socket:
        yield Browser(socket)


def robot(x):
    pose = Pose((x, 0.0, 0.5), UPRIGHT)
    return RobotState(measured=pose, reference=pose, phase=Phase.EXECUTE)


def move(page, browser, steps, **options):
    """Move the robot in steps of 10 ms; the numbers of the moments that came."""
    came = []
    for step in range(steps):
        page.show(PageView(robot=robot(0.001 * step)))
        came += browser.hear(0.01, **options)
    return came


def test_what_moves_is_told_thirty_times_a_second_at_most(page, browser):
    began = time.monotonic()
    came = move(page, browser, 100)
    assert 3 <= len(came) <= 31 * (time.monotonic() - began) + 1


def test_a_browser_that_draws_nothing_gets_two_moments_and_no_more(page, browser):
    assert move(page, browser, 40, drawing=False) == [1, 2]


def test_what_stands_is_told_once(page, browser):
    page.show(PageView(robot=robot(0.0)))
    browser.hear(0.3)
    assert browser.hear(0.5) == []


def test_a_part_of_the_drawing_is_told_when_it_changes(page, browser):
    view = PageView()
    page.show(view)
    browser.hear(0.5)
    assert set(browser.drawing) == set(Drawing.__struct_fields__)
    browser.drawing.clear()
    page.show(replace(view, drawing=msgspec.structs.replace(view.drawing, way=((0.0, 0.0, 0.0),))))
    browser.hear(0.5)
    assert browser.drawing == {"way": [[0.0, 0.0, 0.0]]}


def test_the_cloud_comes_to_a_tab_that_shows_it_and_no_faster_than_it_draws(page, browser):
    def clouds(count):
        came = []
        for number in range(count):
            page.show(PageView(cloud=Picture(bytes([number] * 9), 0.1)))
            came += browser.hear(0.06, kind=CLOUD)
        return came

    assert clouds(3) == []
    browser.say(cloud=True)
    assert clouds(5) == [1, 2]
    browser.say(cloud=True, clouds=2)
    assert clouds(5) == [3, 4]
    browser.say()
    assert clouds(3) == []


def show(page, number, *pictures):
    """The newest of a group of pictures."""
    page.show(PageView(cameras={"head": Picture(bytes(pictures[-1]), 0.1, 0.0, Group(number, Coding.H264, pictures))}))


def test_pictures_that_need_others_come_with_what_the_tab_does_not_have_of_them(page, browser):
    show(page, 1, b"key", b"a")
    browser.hear(0.1)
    show(page, 1, b"key", b"a", b"b")
    browser.hear(0.1)
    show(page, 1, b"key", b"a", b"b", b"c")
    browser.hear(0.1)  # two are under way
    show(page, 1, b"key", b"a", b"b", b"c", b"d")
    browser.say(head=2)
    browser.hear(0.1)
    show(page, 2, b"key2", b"e")
    browser.say(head=3)
    browser.hear(0.1)
    assert browser.pictures == [
        (FROM_KEY, [b"key", b"a"]),
        (GOES_ON, [b"b"]),
        (GOES_ON, [b"c", b"d"]),
        (FROM_KEY, [b"key2", b"e"]),
    ]


def test_a_tab_that_draws_none_of_them_gets_jpeg_files_alone_and_the_cameras_are_asked_for_them(page, browser):
    browser.say()
    browser.hear(0.1)
    assert not page.jpeg_only
    browser.say(jpeg_only=True)
    browser.hear(0.1)
    assert page.jpeg_only
    show(page, 1, b"key")
    browser.hear(0.1)
    page.show(PageView(cameras={"head": Picture(b"j", 0.1)}))
    browser.hear(0.1)
    assert browser.pictures == [(WHOLE, b"j")]
