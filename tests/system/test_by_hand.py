"""A person at the page: sees the prediction fail, corrects it by any device while it runs, sees it learnt."""

import pytest

from services.process.config import load
from tests.browser.scripts import UNDRAWN
from tests.system.hands import HANDS
from tests.system.harness import START_S, Command, Witness, configured, eventually, free_endpoint

pytest.importorskip("playwright.sync_api")

from tests.system.corrector import EPISODE_S, Person, decides, press

pytestmark = [pytest.mark.system, pytest.mark.browser, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

TRIES = 3


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
