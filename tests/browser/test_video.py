"""H.264 in the page: drawn where the browser can decode it; where it cannot the page asks for JPEG files."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from protocol.messages import Coding
from services.bus.picture_stream import Group
from services.camera.coding import H264Coder
from services.camera.wishes import Wish
from services.process.config import CameraSection
from services.station.page.view import Picture

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

WIDTH, HEIGHT = 320, 240
NO_DECODER = "delete window.VideoDecoder;"
BROKEN_DECODER = """if (window.VideoDecoder) VideoDecoder.prototype.decode = () => { throw new Error("broken"); };"""
SUPPORTED = """async () => typeof VideoDecoder === "function"
    && (await VideoDecoder.isConfigSupported({ codec: "avc1.42E01F" })).supported"""
PIXEL = """() => {
    const canvas = document.querySelector("[data-camera=head] canvas");
    const { data } = canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1);
    return [...data.slice(0, 3)];
}"""
COLOURS = [(200, 60, 40), (40, 160, 60), (60, 80, 190), (210, 200, 70)]
CLOSE = 6
"""By so much a colour may differ when it has been coded."""


class Film:
    """A camera that films one colour after another, as the station has it: the page's feed shows what it films."""

    def __init__(self, feed):
        self._feed = feed
        self._coder = H264Coder(CameraSection(codec=Coding.H264))
        self._group = Group(1, Coding.H264, ())

    def show(self, colour, *, key=False):
        """One more picture, of this colour."""
        if key:
            self._coder = H264Coder(CameraSection(codec=Coding.H264))
            self._group = Group(self._group.number + 1, Coding.H264, ())
        coded = self._coder.encode(np.full((HEIGHT, WIDTH, 3), colour, np.uint8), 80, 0, Wish())
        self.give(coded.data)

    def give(self, data):
        """Whatever is sent as a picture."""
        self._group = self._group._replace(pictures=(*self._group.pictures, data))
        self._feed.view = replace(self._feed.view, cameras={"head": Picture(data, 0.02, 0.0, self._group)})


@pytest.fixture
def film(station):
    pytest.importorskip("av")
    _, feed = station
    before = feed.view
    yield Film(feed)
    feed.view = before


@pytest.fixture
def supporting(tab):
    """A tab of a browser that decodes H.264."""
    if not tab.page.evaluate(SUPPORTED):
        pytest.skip("this browser decodes no H.264")
    return tab


def colour(tab):
    """In the middle of the head camera's picture, however the page shows what is old."""
    return np.array(tab.page.evaluate(PIXEL))


def becomes(tab, eventually, wanted, more=lambda: None):
    """Wait until the picture has this colour."""

    def is_seen():
        more()
        tab.page.wait_for_timeout(50)
        return np.max(np.abs(colour(tab) - wanted)) <= CLOSE

    eventually(is_seen)


def test_one_picture_after_another_is_drawn_in_its_colours(supporting, station, film, eventually):
    for wanted in COLOURS:
        becomes(supporting, eventually, wanted, lambda wanted=wanted: film.show(wanted))
    assert not station[0].jpeg_only
    assert supporting.faults == []


def test_a_page_that_is_opened_later_draws_the_newest_at_once(supporting, open_tab, film, eventually):
    for wanted in COLOURS:
        film.show(wanted)
    later = open_tab()
    for wanted in COLOURS[-1:] + COLOURS[:1]:
        becomes(later, eventually, wanted, lambda wanted=wanted: film.show(wanted))
    assert later.faults == []


def test_garbage_draws_nothing_and_the_next_key_picture_is_drawn(supporting, film, eventually):
    becomes(supporting, eventually, COLOURS[0], lambda: film.show(COLOURS[0]))
    for data in (b"no picture", bytes(4), b"", b"\x00\x00\x00\x01\x67" + bytes(range(200))):
        film.give(data)
        supporting.page.wait_for_timeout(150)
    film.show(COLOURS[1])
    supporting.page.wait_for_timeout(150)
    assert np.max(np.abs(colour(supporting) - COLOURS[0])) <= CLOSE
    film.show(COLOURS[2], key=True)
    becomes(supporting, eventually, COLOURS[2], lambda: film.show(COLOURS[2]))
    assert supporting.faults == []


def test_a_browser_without_a_decoder_asks_for_jpeg_files_and_draws_them(station, open_tab, film, eventually):
    page, feed = station
    without = open_tab(script=NO_DECODER)
    eventually(lambda: page.jpeg_only or without.page.wait_for_timeout(50))

    def sent():
        """What a camera sends that is asked for it."""
        jpeg = cv2.imencode(".jpg", np.full((HEIGHT, WIDTH, 3), COLOURS[3][::-1], np.uint8))[1].tobytes()
        feed.view = replace(feed.view, cameras={"head": Picture(jpeg, 0.02)})

    film.show(COLOURS[0])
    becomes(without, eventually, COLOURS[3], sent)
    without.close()
    eventually(lambda: not page.jpeg_only)
    assert without.faults == []


def test_a_decoder_that_decodes_nothing_counts_as_none(station, open_tab, film, eventually):
    page, _ = station
    broken = open_tab(script=BROKEN_DECODER)

    def asks():
        film.show(COLOURS[0], key=True)
        return page.jpeg_only or broken.page.wait_for_timeout(100)

    eventually(asks)
    assert broken.faults == []
