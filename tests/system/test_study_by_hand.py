"""A participant in a real browser: consent, and a training by keyboard on the robot's page in the frame of theirs."""

import contextlib

import pytest

from services.offline.people.ways import Teaching
from services.process.config import load
from services.study.events import Attempted, Ended
from services.study.journal import read
from tests.browser.scripts import UNDRAWN
from tests.ports import free_port
from tests.system.hands import OnKeys
from tests.system.harness import START_S, Command, Witness, eventually
from tests.system.studies import TRAINING, study_in, written

pytest.importorskip("playwright.sync_api")

from tests.system.corrector import EPISODE_S, Person, decides, press

pytestmark = [pytest.mark.system, pytest.mark.browser, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

TRIES = 3


class Framed:
    """The robot's page in the frame of the participant's, as a page: what is typed goes to whoever has the focus."""

    def __init__(self, page):
        self._page = page
        self.keyboard = page.keyboard
        self.wait_for_timeout = page.wait_for_timeout
        self._frame = page.wait_for_selector("iframe.robot").content_frame()
        self.evaluate, self.locator = self._frame.evaluate, self._frame.locator


@pytest.fixture
def tab(browser):
    """A tab whose robot's page shows no tour; nobody looks at its 3-D view: the person goes by what the robot says."""
    opened = browser.new_page(viewport={"width": 1280, "height": 800})
    opened.add_init_script(f"localStorage.setItem('retouch-tour', 'seen'); {UNDRAWN}")
    yield opened
    opened.close()


def test_a_participant_trains_by_keyboard_in_the_frame(tmp_path, tab):
    folder = study_in(tmp_path / "study", device="keyboard", scene="dishwasher", place=[0.86, 0.06, 0.553], successes=1)
    port = free_port()
    command = ("study", "run", folder, "--synthetic", "1", "--no-browser", "--port", port)
    with contextlib.ExitStack() as stack:
        study = stack.enter_context(Command(*command, folder=tmp_path))
        study.until(lambda: "participants go to" in study.out, START_S, "the pages are there")
        tab.goto(f"http://127.0.0.1:{port}/participant/1")
        tab.check("#agree")
        tab.click("button.go")
        tab.get_by_role("button", name="Begin").click()
        tab.wait_for_selector("iframe.robot", timeout=START_S * 1e3)
        made = load(written(folder, TRAINING))
        witness = stack.enter_context(Witness(made.connect, made.name))
        page = Framed(tab)
        person = Person(page, OnKeys(page), witness)

        def told():
            return [entry.event for entry in read(folder / "raw") if isinstance(entry.event, Attempted | Ended)]

        def over(count):
            """The person leads on until so many attempts are told, and they are asked again, or all is over."""
            done = told()
            if done and isinstance(done[-1], Ended):
                return done
            person.look()
            return done if len(done) >= count and decides(page, witness, count) else None

        press(page, "execute")
        done = eventually(lambda: over(1), EPISODE_S, study.tail)
        assert (done[0].teaching, done[0].collision) == (None, True)
        while not isinstance(done[-1], Ended):  # where a hand comes too late on a busy machine, it tries again
            made_so_far = len(done)
            assert made_so_far <= TRIES, study.tail()
            person.begin()
            press(page, "refine")
            done = eventually(lambda so_far=made_so_far: over(so_far + 1), EPISODE_S, study.tail)
        *_, led, ended = done
        assert (led.teaching, led.success, ended.part, ended.passed) == (Teaching.PREDICTION, True, TRAINING, True)
        assert 5.0 < led.active < 60.0
        assert ended.seconds == pytest.approx(sum(one.active for one in done[:-1]), abs=0.01)
        tab.wait_for_selector("iframe.robot", state="detached")
        assert study.stop() == 0
