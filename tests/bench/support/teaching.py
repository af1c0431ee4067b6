"""How long a scripted person needs to teach a skill from nothing: by waypoints, with the keyboard at the page."""

import time

from sim.tasks import TABLE
from tests.bench.support.results import Result
from tests.system.teacher import Teacher

SCENE = "table"
GOAL_S = 90.0
"""Of a person's time, from the first press to a skill that has learnt."""


def teach(page, witness):
    """Teach the table's empty skill by waypoints; the figures.

    Args:
        page: the browser's page, open and armed.
        witness: of the robot's network.
    """
    teacher = Teacher(page, witness)
    teacher.decides()
    began = time.monotonic()
    teacher.choose("waypoints")
    teacher.take_up()
    # Where the gripper begins is where the motion begins: the first place of the way is no waypoint.
    for place in TABLE.corridor(TABLE.variants[-1], teacher.object_seen()).positions[1:]:
        teacher.store(place)
    teacher.done()
    stored = len(teacher.decides().waypoints)
    busy = time.monotonic() - began
    teacher.press("execute")
    learnt = teacher.decides(attempts=1)
    took = time.monotonic() - began
    teacher.press("execute")
    alone = teacher.decides(attempts=2).attempts[-1]
    return [
        Result("empty skill by waypoints: a person's time until it is learnt", took, "s", GOAL_S),
        Result("of it, until the motion is previewed", busy, "s"),
        Result("waypoints", stored, "1"),
        Result("learnt", learnt.updates, "1"),
        Result("the robot alone afterwards succeeds", float(alone.verdict.success), "1"),
    ]
