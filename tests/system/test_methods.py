"""Each method from an empty skill to a model that can: a person leads the robot with the keyboard, on the page."""

import numpy as np
import pytest

from protocol.messages import Mode
from services.process.config import load
from sim.tasks import TABLE
from tests.browser.scripts import UNDRAWN
from tests.system.harness import START_S, Command, Witness, configured, free_endpoint
from tests.system.teacher import Teacher

pytest.importorskip("playwright.sync_api")

pytestmark = [pytest.mark.system, pytest.mark.browser, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]


@pytest.fixture
def teacher(tmp_path, browser):
    """A person at the page of a robot at the table, whose skill is empty."""
    endpoint = free_endpoint()
    configuration = configured(tmp_path, endpoint)
    station = load(configuration).station
    up = ("up", "--fresh", "--untaught", "--no-browser", "--scene", "table", "--config", configuration)
    up += ("--only", "robot,camera,perception,master,model,station")  # nobody looks at a recording
    with Command(*up, folder=tmp_path) as command, Witness(endpoint) as witness:
        command.until(lambda: witness.teaching, START_S, "the station is there")
        page = browser.new_page(viewport={"width": 1280, "height": 720})
        page.add_init_script(f"localStorage.setItem('retouch-tour', 'seen'); {UNDRAWN}")
        page.goto(f"http://{station.host}:{station.port}/")
        yield Teacher(page, witness)
        page.close()


def way(teacher):
    """Where a person would lead the gripper, shape (n, 3) [m]: round what stands there, to the object."""
    return TABLE.corridor(TABLE.variants[-1], teacher.object_seen()).positions


def test_waypoints_teach_an_empty_skill(teacher):
    asked = teacher.decides()
    assert "Nothing is learnt yet" in asked.text
    teacher.choose("waypoints")
    teacher.take_up()
    for place in way(teacher)[1:]:
        teacher.store(place)
    teacher.done()
    previewed = teacher.decides()
    assert len(previewed.waypoints) == len(way(teacher)) - 1
    assert previewed.recommended == "execute"
    teacher.press("execute")
    learnt = teacher.decides(attempts=1)
    assert learnt.attempts[0].verdict.success
    assert learnt.updates == 1
    teacher.press("execute")
    alone = teacher.decides(attempts=2).attempts[-1]
    assert (alone.mode, alone.operator_input) == (Mode.AUTONOMOUS, False)
    assert alone.verdict.success


@pytest.mark.long
def test_a_demonstration_teaches_an_empty_skill(teacher):
    teacher.decides()
    teacher.choose("demonstrate")
    teacher.take_up()
    for place in np.array(way(teacher))[1:]:
        teacher.lead_to(place)
    teacher.done()
    shown = teacher.decides(attempts=1)
    assert shown.attempts[0].verdict.success
    assert shown.updates == 0, "nothing is learnt unasked"
    assert shown.recommended == "teach"
    teacher.press("teach")
    assert teacher.decides(attempts=1).updates == 1
    teacher.press("execute")
    alone = teacher.decides(attempts=2).attempts[-1]
    assert alone.mode is Mode.AUTONOMOUS
    assert alone.verdict.success
