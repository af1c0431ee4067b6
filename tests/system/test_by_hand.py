"""A person at the page: sees the prediction fail, corrects it by any device while it runs, sees it learnt."""

import contextlib

import numpy as np
import pytest

from protocol import topics
from protocol.messages import Mode, Phase
from services.bus.arrays import motion_from_wire
from services.bus.predictions import Predictions
from services.process.config import load
from sim.person.intention import plan
from sim.tasks import DISHWASHER
from tests.browser.scripts import UNDRAWN
from tests.system.hands import HANDS
from tests.system.harness import START_S, Command, Witness, configured, eventually, free_endpoint

playwright = pytest.importorskip("playwright.sync_api")

pytestmark = [pytest.mark.system, pytest.mark.browser, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

EPISODE_S = 120.0
TRIES = 3
SHOWN = """[document.body.matches('[data-let-go]') || document.querySelector('.device-trouble').textContent !== '',
    document.querySelector('[data-action=go_on]:enabled') !== null]"""
"""Whether the page says to let go, and whether it asks to go on: one look, not one for each."""

LEAD = 0.03
"""A person looks a little ahead: share of the motion."""


class Person:
    """Looks at where the robot is and where it should be, leads it there, and lets it go on if it asks.

    Args:
        page: the browser's page.
        hand: on a device.
        witness: of the robot's network, in place of eyes.
    """

    def __init__(self, page, hand, witness):
        self._page = page
        self._witness = witness
        self._predictions = Predictions(witness.bus)
        self._execution = witness.bus.subscribe(topics.EXECUTION)
        self._seen = witness.bus.subscribe(topics.OBJECT_POSE)
        self._hand = hand
        self._correction = None

    def begin(self):
        """Another motion to correct."""
        self._correction = None

    def look(self):
        """One look, and what it calls for: to lead, or to let go, or to go on."""
        robot = self._witness.robot
        let_go, asked = self._page.evaluate(SHOWN)
        if let_go:
            self._hand.rest()
            return
        if asked:
            self._hand.rest()
            # The robot may not ask any more by now.
            with contextlib.suppress(playwright.TimeoutError):
                press(self._page, "go_on", within_s=1.0)
            return
        if robot is None or robot.mode is not Mode.REFINE or robot.phase is not Phase.EXECUTE:
            self._hand.rest()
            return
        wanted = self._wanted(robot.progress)
        if wanted is None:
            return
        self._hand.steer(wanted, np.array(robot.offset))

    def _wanted(self, progress):
        if self._correction is None:
            received, seen = self._execution.latest(), self._seen.latest()
            if received is None or received.message.mode is not Mode.REFINE or seen is None:
                return None
            place = np.array(seen.message.pose.position)
            ways = [DISHWASHER.corridor(variant, place) for variant in DISHWASHER.variants]
            predicted = self._predictions.motion(received.message.prediction)
            if predicted is None:
                return None
            positions, orientations, _ = motion_from_wire(predicted)
            self._correction = plan(positions, orientations, ways[1], ways)
        return self._correction.displacement(min(1.0, progress + LEAD))


@pytest.fixture
def page(browser):
    """A page of a real Chromium."""
    opened = browser.new_page(viewport={"width": 1280, "height": 720})
    yield opened
    opened.close()


KEYS, *OTHERS = HANDS


@pytest.mark.parametrize(
    "on_device",
    [KEYS, *(pytest.param(hand, marks=pytest.mark.long) for hand in OTHERS)],
    ids=lambda hand: hand.device,
)
def test_one_correction_by_hand_is_learnt(on_device, tmp_path, page):
    endpoint = free_endpoint()
    configuration = configured(tmp_path, endpoint)
    station = load(configuration).station
    with (
        Command("up", "--fresh", "--no-browser", "--config", configuration, folder=tmp_path) as up,
        Witness(endpoint) as witness,
    ):
        up.until(lambda: witness.teaching, START_S, "the station is there")
        # Nobody looks at the 3-D view: the person goes by what the robot says.
        page.add_init_script(f"localStorage.setItem('retouch-tour', 'seen'); {UNDRAWN} {on_device.script}")
        page.goto(f"http://{station.host}:{station.port}/")

        person = Person(page, on_device(page), witness)

        def decided(attempts):
            return eventually(lambda: person.look() or decides(page, witness, attempts), EPISODE_S, up.tail)

        press(page, "execute")
        teaching = decided(1)
        assert teaching.attempts[0].verdict.collision
        made = 1
        while not teaching.updates:  # where a hand comes too late on a busy machine, it tries again
            assert made <= TRIES, up.tail()
            made += 1
            person.begin()
            press(page, "refine")
            teaching = decided(made)
        press(page, "execute")
        teaching = decided(made + 1)

        *_, refined, last = teaching.attempts
        assert teaching.updates == 1
        assert refined.operator_input
        assert refined.verdict.success
        assert last.verdict.success
        assert not last.operator_input
        assert teaching.loop_closed


def press(page, action, within_s=EPISODE_S):
    """Press a button of the page once it is offered."""
    page.locator(f"[data-action={action}]:enabled").click(timeout=within_s * 1e3)


def decides(page, witness, attempts):
    """The workflow that waits for the operator after so many episodes, or None; the browser lives on meanwhile."""
    page.wait_for_timeout(20)
    teaching = witness.teaching
    waits = teaching is not None and teaching.phase == "deciding" and len(teaching.attempts) >= attempts
    return teaching if waits else None
