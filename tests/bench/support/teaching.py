"""How long a scripted person needs to teach a skill from nothing: by waypoints, with the keyboard at the page."""

import time

from sim.tasks import TABLE
from tests.bench.support.results import Result
from tests.system.teacher import Teacher

SCENE = "table"
GOAL_S = 90.0
"""Of a person's time at a place, from the first press until what was shown there is learnt."""


def teach(page, witness):
    """Teach the table's empty skill by waypoints; the figures.

    Args:
        page: the browser's page, open and armed.
        witness: of the robot's network.
    """
    teacher = Teacher(page, witness)
    teacher.decides()
    teacher.choose("waypoints")
    busy, took, stored = [], [], []
    for attempts in (1, 2):
        began = time.monotonic()
        teacher.press("put")
        teacher.decides()
        teacher.take_up()
        # Where the gripper begins is where the motion begins: the first place of the way is no waypoint.
        for place in TABLE.corridor(TABLE.variants[-1], teacher.object_seen()).positions[1:]:
            teacher.store(place)
        teacher.done()
        stored.append(len(teacher.decides().waypoints))
        busy.append(time.monotonic() - began)
        teacher.press("execute")
        teacher.decides(attempts)
        teacher.press("teach")
        teacher.decides(attempts)
        took.append(time.monotonic() - began)
    teacher.press("execute")
    alone = teacher.decides(attempts=3).attempts[-1]
    return [
        Result("empty skill by waypoints: a person's time until a place is learnt", max(took), "s", GOAL_S),
        Result("of it, until the motion is previewed", max(busy), "s"),
        Result("waypoints", max(stored), "1"),
        Result("places learnt", len(took), "1"),
        Result("the robot alone afterwards succeeds", float(alone.verdict.success), "1"),
    ]
