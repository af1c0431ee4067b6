"""What the page's regions say, as values that the browser shows."""

from protocol.messages import Recording
from services.station.page.panels import scene
from services.station.page.view import PageView, Shown


def shown(fault=""):
    recording = Recording(path="a.rrd", viewer_url="http://127.0.0.1:9090/", recording_id="first", fault=fault)
    return Shown(PageView(recording=recording), 0.0)


def test_a_recording_that_broke_off_says_so_until_it_goes_on():
    fault = "Nothing is recorded: no space left on device"
    assert scene(shown(fault))["recording-fault"] == fault
    assert scene(shown())["recording-fault"] == ""


def test_without_a_viewer_nothing_is_said_about_a_recording():
    assert scene(Shown(PageView(), 0.0))["recording-fault"] == ""
