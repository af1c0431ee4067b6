"""The station's page in a frame of the participant's: it steers there, holds when left, and is shown by nobody else."""

import pytest
from study_person import parts

pytest.importorskip("uvicorn")
from playwright.sync_api import expect

from services.study.page import acts
from tests.browser import scripts
from tests.ports import free_port
from tests.study_harness import Served

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]


@pytest.fixture
def framed(tmp_path):
    """A study and a station that lets the study's page show it; participant 1's training runs."""
    from harness import served

    port, stations = free_port(), free_port()
    study = Served(tmp_path / "raw", port, f"http://localhost:{stations}/?name=Participant+1")
    with served(port=stations, framed_by=f"http://127.0.0.1:{port}") as (page, _):
        study.page.start()
        conductor = study.desk.conductor
        conductor.enrol(1, "en")
        conductor.consent(1, "en")
        parts(study, 1)
        study.desk.participant_does(1, acts.Begin(part=conductor.now(1).name, language="en"))
        yield study, page
        study.page.close()
        study.journal.close()


def test_keys_reach_the_station_in_the_frame_until_something_else_has_them(framed, browser, eventually):
    study, station = framed
    context = browser.new_context(viewport={"width": 1280, "height": 720})
    tab = context.new_page()
    tab.add_init_script(f"{scripts.TOURED} {scripts.UNDRAWN}")
    tab.goto(study.page.participant_url(1))
    frame = tab.frame_locator("iframe")
    expect(frame.locator("body")).to_have_attribute("data-link", "armed", timeout=60_000)
    eventually(lambda: station.take_input().focused)
    tab.keyboard.down("KeyE")
    eventually(lambda: station.take_input().keys == ("KeyE",))
    tab.click("#withdraw")
    eventually(lambda: not station.take_input().focused and not station.take_input().keys)
    tab.keyboard.up("KeyE")
    context.close()


def test_a_page_that_the_station_does_not_name_cannot_show_it(browser, eventually):
    from harness import served

    with served(port=free_port(), framed_by="http://127.0.0.1:9") as (page, _):
        context = browser.new_context()
        tab = context.new_page()
        told = []
        tab.on("console", lambda message: told.append(message.text))
        tab.set_content(f'<iframe src="{page.url}/"></iframe>')
        eventually(lambda: tab.wait_for_timeout(20) or any("frame-ancestors" in text for text in told))
        context.close()
