"""A participant in a real browser: consent, and a training by each method at the robot's page in a frame of theirs."""

import contextlib
from dataclasses import dataclass

import pytest

from services.offline.people.ways import Device, Teaching
from services.process.config import load
from services.study.events import Attempted, Ended
from services.study.journal import read
from sim.tasks import DISHWASHER, TABLE, ReachingScene
from tests.browser.scripts import UNDRAWN
from tests.ports import free_port
from tests.system.hands import OnKeys, Simulated
from tests.system.harness import START_S, Command, Witness, eventually
from tests.system.studies import TRAINING, study_in, written

pytest.importorskip("playwright.sync_api")

from tests.system.corrector import EPISODE_S, Person, decides
from tests.system.teacher import Teacher

pytestmark = [pytest.mark.system, pytest.mark.browser, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

PLACES = {DISHWASHER.name: [0.86, 0.06, 0.553], TABLE.name: [0.75, 0.13, 0.71]}

THERE = """[...document.querySelectorAll('[data-action], [role=slider]:not([disabled]), input, select, a[href]')]
    .filter((one) => one.checkVisibility()).map((one) => one.dataset.action ?? one.className)"""
"""All that is there to be pressed, slid, filled in or followed; a slider that is not to be slid shows a share."""


class Framed:
    """The robot's page in the frame of the participant's, as a page: what is typed goes to whoever has the focus."""

    def __init__(self, page):
        self._page = page
        self.keyboard = page.keyboard
        self.wait_for_timeout = page.wait_for_timeout
        self._frame = page.wait_for_selector("iframe.robot").content_frame()
        self.evaluate, self.locator = self._frame.evaluate, self._frame.locator


@dataclass(frozen=True)
class Trial:
    """A method of the thesis, and how a person goes about it.

    Attributes:
        scene: in which it is trained.
        acts: what is pressed for the robot to be led or corrected.
        tries: how often; a hand that comes too late on a busy machine tries again.
    """

    teaching: Teaching
    device: Device
    scene: ReachingScene
    acts: str
    tries: int = 3

    def __str__(self):
        return f"{self.teaching.value}-{self.device.value}"

    def is_tried(self, teacher):
        """What a person does until a motion runs that counts; who corrects by keys does so then."""
        if self.acts != "lead" or self.device is not Device.KEYBOARD:
            teacher.press(self.acts)
            return
        teacher.take_up()
        stores = self.teaching is Teaching.WAYPOINTS
        for place in self.scene.corridor(self.scene.variants[-1], teacher.object_seen()).positions[1:]:
            (teacher.store if stores else teacher.lead_to)(place)
        teacher.done()
        if stores:
            teacher.decides()
            teacher.press("execute")


@pytest.fixture
def tab(browser):
    """A tab whose robot's page shows no tour; nobody looks at its 3-D view: the person goes by what the robot says."""
    opened = browser.new_page(viewport={"width": 1280, "height": 800})
    opened.add_init_script(f"localStorage.setItem('retouch-tour-P01', 'seen'); {UNDRAWN}")
    yield opened
    opened.close()


def long(trial):
    """What others show, too."""
    return pytest.param(trial, marks=pytest.mark.long)


@pytest.mark.parametrize(
    "trial",
    [
        Trial(Teaching.PREDICTION, Device.KEYBOARD, DISHWASHER, "refine"),
        Trial(Teaching.WAYPOINTS, Device.KEYBOARD, TABLE, "lead", tries=1),
        long(Trial(Teaching.PREDICTION, Device.STYLUS, DISHWASHER, "refine")),
        long(Trial(Teaching.DEMONSTRATION, Device.STYLUS, TABLE, "lead")),
        long(Trial(Teaching.DEMONSTRATION, Device.KEYBOARD, TABLE, "lead")),
    ],
    ids=str,
)
def test_a_participant_trains_in_the_frame(trial, tmp_path, tab):
    folder = study_in(
        tmp_path / "study",
        trial.teaching,
        device=trial.device.value,
        scene=trial.scene.name,
        place=PLACES[trial.scene.name],
        successes=1,
    )
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
        teacher = Teacher(page, witness)
        person = Person(page, (OnKeys if trial.device is Device.KEYBOARD else lambda _: Simulated())(page), witness)

        def told():
            return [entry.event for entry in read(folder / "raw") if isinstance(entry.event, Attempted | Ended)]

        def over(count):
            """The person leads on until so many attempts are told, and they are asked again, or all is over.

            That it is over is written after the attempt with which it is.
            """
            done = told()
            if done and isinstance(done[-1], Ended):
                return done
            person.look()
            goes_on = len(done) >= count and not done[-1].success
            return done if goes_on and decides(page, witness, count) else None

        teacher.decides()
        offered = {"skip", "execute", trial.acts, "stop"}
        teacher.until(lambda: set(page.evaluate(THERE)) == offered, START_S, f"only {offered} are there")
        done, alone = [], 0
        if trial.teaching is Teaching.PREDICTION:  # what is to be corrected is seen first
            teacher.press("execute")
            done, alone = eventually(lambda: over(1), EPISODE_S, study.tail), 1
            assert (done[0].teaching, done[0].collision) == (None, True)
        while not done or not isinstance(done[-1], Ended):
            so_far = len(done)
            assert so_far - alone < trial.tries, done
            person.begin()
            trial.is_tried(teacher)
            done = eventually(lambda count=so_far + 1: over(count), EPISODE_S, study.tail)
        *_, led, ended = done
        assert (led.teaching, led.success, ended.part, ended.passed) == (trial.teaching, True, TRAINING, True)
        assert 5.0 < led.active < 120.0
        # What was stored is tried by the robot alone; else it is tried as it is led.
        assert (led.raw["alone"] > 0.0) is (trial.teaching is Teaching.WAYPOINTS)
        assert ended.seconds == pytest.approx(sum(one.active for one in done[:-1]), abs=0.01)
        tab.wait_for_selector("iframe.robot", state="detached")
        assert study.stop() == 0
