"""Each method from an empty skill to a model that can: a person leads the robot with the keyboard, on the page."""

from itertools import pairwise

import numpy as np
import pytest

from protocol.messages import Mode, Showing, ShowStep
from services.process.config import load
from sim.tasks import TABLE
from tests.browser.scripts import UNDRAWN
from tests.system.harness import START_S, Command, Witness, configured, free_endpoint
from tests.system.teacher import Teacher

pytest.importorskip("playwright.sync_api")

APART_M = 0.03
"""A hand on the keys goes along one axis at a time: so far it leads before it looks where the way is."""

OTHER_PLACES = 3
"""That a hand takes which has touched something on the way."""

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


def put(teacher, number):
    """Have the object put where the page proposes it; what the page says then."""
    asked = teacher.decides()
    assert asked.showing == Showing(ShowStep.PLACE, number, 2), asked
    teacher.press("put")
    return teacher.decides()


def lead_there(teacher):
    """Lead the gripper to the object in one go; what the page says then."""
    teacher.take_up()
    led = np.array(way(teacher))
    for begin, end in pairwise(led):
        for share in np.linspace(0.0, 1.0, 1 + max(1, round(np.linalg.norm(end - begin) / APART_M)))[1:]:
            teacher.lead_to(begin + share * (end - begin))
    teacher.done()
    return teacher.decides()


def replay(teacher):
    """See the robot do alone what it was shown, and have it keep that; where the object stood."""
    before = len(teacher.decides().attempts)
    teacher.press("execute")
    done = teacher.decides(attempts=before + 1)
    assert done.attempts[-1].verdict.success
    assert (done.showing.step, done.recommended) == (ShowStep.KEEP, "teach")
    teacher.press("teach")
    return done.attempts[-1].object_position


def does_it_alone(teacher):
    """Whether the loop goes on with a robot that can."""
    asked = teacher.decides()
    assert (asked.showing, asked.recommended) == (None, "execute"), asked
    teacher.press("execute")
    alone = teacher.decides(attempts=len(asked.attempts) + 1).attempts[-1]
    assert (alone.mode, alone.operator_input) == (Mode.AUTONOMOUS, False)
    return alone.verdict.success


def test_waypoints_teach_an_empty_skill_at_two_places(teacher):
    asked = teacher.decides()
    assert "learnt nothing" in asked.text
    teacher.choose("waypoints")
    places = []
    for number in (1, 2):
        put(teacher, number)
        teacher.take_up()
        led = way(teacher)[1:]
        for place in led:
            teacher.store(place)
        teacher.done()
        previewed = teacher.decides()
        assert len(previewed.waypoints) == len(led)
        assert previewed.recommended == "execute"
        places.append(replay(teacher))
    assert np.linalg.norm(np.subtract(*places)) > 0.1
    assert does_it_alone(teacher)


@pytest.mark.long
def test_a_demonstration_teaches_an_empty_skill_at_two_places(teacher):
    teacher.decides()
    teacher.choose("demonstrate")
    for number in (1, 2):
        put(teacher, number)
        shown = lead_there(teacher)
        for _ in range(OTHER_PLACES):
            if shown.attempts[-1].verdict.success:
                break
            assert "teach" not in shown.actions, "what touched something on the way cannot be kept"
            teacher.press("other_place")
            teacher.decides()
            shown = lead_there(teacher)
        assert shown.attempts[-1].verdict.success
        assert shown.recommended == "execute", "it is seen before it is kept"
        replay(teacher)
    assert does_it_alone(teacher)
