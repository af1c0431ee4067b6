"""H.264 from the camera to who looks: the right picture or none, whatever is lost or damaged on the way."""

import cv2
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from protocol.messages import Coding
from services.bus.picture_stream import Group
from services.camera.coding import KEY_APART_NS, KEY_EVERY_NS, jpeg
from services.camera.wishes import Wish
from services.process.config import CameraSection
from services.process.exceptions import RoomMissing, UnusableSetting
from services.video import library
from services.video.decoder import Decoder
from tests.services.video.moving import H264, HEIGHT, PERIOD_S, WIDTH, Filmed, number, scene

pytest.importorskip("av")
pytestmark = pytest.mark.sim  # codes some thousand pictures

AS_GOOD_AS_DB = 28.0
SECOND = round(1.0 / PERIOD_S)


@pytest.fixture
def filmed():
    return Filmed()


def shown(filmed, decoder):
    """The picture that is seen now; None where there is no new one."""
    filmed.stream.latest()
    return decoder.rgb(filmed.stream.group)


def test_what_is_seen_is_what_was_filmed(filmed):
    decoder = Decoder()
    for _ in range(3 * SECOND):
        tick = filmed.film()
        picture = shown(filmed, decoder)
        assert number(picture) == tick
        assert cv2.PSNR(picture, scene(tick)) > AS_GOOD_AS_DB


def test_it_takes_less_than_half_the_bytes_of_jpeg_files_that_are_as_good(filmed):
    decoder, size, psnr = Decoder(), 0, []
    for _ in range(2 * SECOND):
        tick = filmed.film()
        size += len(filmed.sent[-1].data)
        psnr.append(cv2.PSNR(shown(filmed, decoder), scene(tick)))
    files = [jpeg(scene(tick), 50) for tick in range(2 * SECOND)]
    decoded = [cv2.cvtColor(cv2.imdecode(np.frombuffer(one, np.uint8), 1), cv2.COLOR_BGR2RGB) for one in files]
    assert np.mean(psnr) >= np.mean([cv2.PSNR(one, scene(tick)) for tick, one in enumerate(decoded)])
    assert size < 0.5 * sum(map(len, files))


@settings(deadline=None, max_examples=15, suppress_health_check=list(HealthCheck))
@given(losses=st.lists(st.booleans(), min_size=20, max_size=40), looks=st.integers(1, 5))
def test_a_picture_that_was_lost_never_yields_a_wrong_one(losses, looks):
    filmed, decoder = Filmed(), Decoder()
    for lost in losses:
        tick = filmed.film(lost=lost)
        if tick % looks:  # who looks now and then sees all the same what came meanwhile
            continue
        picture = shown(filmed, decoder)
        assert picture is None or number(picture) <= tick
        assert picture is None or cv2.PSNR(picture, scene(number(picture))) > AS_GOOD_AS_DB
        assert not (lost and picture is not None and number(picture) == tick)


def test_after_a_loss_nothing_new_is_seen_until_a_key_picture_which_comes_where_it_is_asked_for(filmed):
    decoder = Decoder()
    filmed.film()
    assert shown(filmed, decoder) is not None
    filmed.film(lost=True)
    for _ in range(4):
        filmed.film()
        assert shown(filmed, decoder) is None
        assert filmed.stream.waits
    tick = filmed.film(wish=Wish(key=True))
    assert number(shown(filmed, decoder)) == tick
    assert not filmed.stream.waits


def test_whoever_keeps_asking_gets_a_key_picture_now_and_then_and_not_each_time(filmed):
    for _ in range(2 * SECOND):
        filmed.film(wish=Wish(key=True))
    keys = sum(coded.after_key == 0 for coded in filmed.sent)
    assert 2 * 1e9 / KEY_APART_NS - 2 <= keys <= 2 * 1e9 / KEY_APART_NS + 1


def test_a_key_picture_comes_every_second(filmed):
    for _ in range(5 * SECOND):
        filmed.film()
    places = [index for index, coded in enumerate(filmed.sent) if coded.after_key == 0]
    assert places[0] == 0
    assert np.diff(places) == pytest.approx(KEY_EVERY_NS / 1e9 / PERIOD_S, abs=1)


def test_who_comes_later_sees_it_from_the_next_key_picture_on(filmed):
    for _ in range(SECOND // 2):
        filmed.film(lost=True)
    assert shown(filmed, Decoder()) is None
    for _ in range(SECOND):
        filmed.film()
    assert number(shown(filmed, Decoder())) == SECOND // 2 + SECOND - 1


def test_while_somebody_can_show_nothing_else_it_is_jpeg(filmed):
    decoder = Decoder()
    filmed.film()
    filmed.film(wish=Wish(jpeg_only=True))
    coded = filmed.sent[-1]
    assert (coded.coding, coded.after_key) == (Coding.JPEG, 0)
    assert filmed.stream.latest().message.data == coded.data
    assert filmed.stream.group.coding is Coding.JPEG
    tick = filmed.film()
    assert number(shown(filmed, decoder)) == tick


def test_less_quality_is_fewer_bytes_at_once(filmed):
    def of_a_second(quality):
        for _ in range(SECOND):
            filmed.film(quality=quality)
        return sum(len(coded.data) for coded in filmed.sent[-SECOND:])

    of_a_second(80)
    good = of_a_second(80)
    assert of_a_second(25) < 0.6 * good
    assert of_a_second(80) > 0.8 * good


@pytest.mark.parametrize("cut", ["garbage", "half", "empty", "another"])
def test_what_is_no_picture_is_counted_and_shown_by_nobody(filmed, cut, capfd):
    decoder = Decoder()
    filmed.film()
    good = filmed.sent[-1].data
    noise = np.random.default_rng(2).bytes(3_000)
    bad = {"garbage": noise, "half": good[: len(good) // 2], "empty": b"", "another": good[:40] + noise}[cut]
    assert decoder.rgb(Group(7, Coding.H264, (bad,))) is None
    assert decoder.waits
    assert decoder.undecodable == 1
    assert decoder.rgb(Group(7, Coding.H264, (bad, good))) is None, "of the same group nothing more is believed"
    assert decoder.undecodable == 1
    assert number(decoder.rgb(Group(8, Coding.H264, (good,)))) == 0
    assert not decoder.waits
    assert capfd.readouterr().err == ""


def test_what_claims_to_be_huge_takes_no_memory():
    large = Filmed(CameraSection(codec=Coding.H264, width=1920, height=1080))
    coded = large.coder.encode(np.zeros((1080, 1920, 3), np.uint8), 80, 0, Wish())
    assert Decoder().rgb(Group(1, Coding.H264, (coded.data,))).shape == (1080, 1920, 3)
    import av

    context = av.CodecContext.create("libx264", "w")
    context.width, context.height, context.pix_fmt, context.time_base = 4096, 4096, "yuv420p", 1
    context.options = {"preset": "ultrafast", "tune": "zerolatency"}
    frame = av.VideoFrame(4096, 4096, "yuv420p")
    frame.pts = 0
    (huge,) = context.encode(frame)
    decoder = Decoder()
    assert decoder.rgb(Group(1, Coding.H264, (bytes(huge),))) is None
    assert decoder.undecodable == 1


@given(noise=st.lists(st.binary(max_size=200), min_size=1, max_size=5))
@settings(deadline=None, max_examples=100)
def test_any_bytes_are_a_picture_or_none(noise):
    decoder = Decoder()
    for index, one in enumerate(noise):
        decoder.rgb(Group(index, Coding.H264, (b"\x00\x00\x00\x01" + one,)))


def test_it_becomes_a_jpeg_file_that_is_as_good(filmed):
    tick = filmed.film()
    filmed.stream.latest()
    data = Decoder().jpeg(filmed.stream.group)
    picture = cv2.cvtColor(cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)
    assert picture.shape == (HEIGHT, WIDTH, 3)
    assert cv2.PSNR(picture, scene(tick)) > AS_GOOD_AS_DB


def test_an_odd_size_is_refused_in_one_line():
    with pytest.raises(UnusableSetting, match=r"\[camera\] width.*even"):
        Filmed(CameraSection(codec=Coding.H264, width=321))


def test_without_the_library_the_camera_says_what_to_install_and_others_ask_for_jpeg(monkeypatch):
    monkeypatch.setattr(library, "MODULE", "there_is_no_such_module")
    with pytest.raises(RoomMissing, match=r"retouch\[video\]"):
        Filmed(H264)
    assert not Decoder().is_able
    assert Decoder().rgb(Group(1, Coding.H264, (b"",))) is None
