"""When a part is over: what the protocol says of its attempts, and nothing else."""

import pytest

from services.offline.people.ways import Teaching
from services.study.events import Attempted
from services.study.protocol.protocol import Task, Training
from services.study.session.rules import Standing, adapted, standing, trained

RULE = Training(successes=2, of_last=4, minutes=30.0, attempts=6)
TASK = Task(updates=2, refinements=3)


def attempts(said, updates=0):
    """Attempts, a letter each: s and f are led, S and F the robot's alone; capital or not, s succeeded."""
    return [
        Attempted(
            participant=1,
            part="A/1",
            number=number,
            teaching=None if letter.isupper() else Teaching.PREDICTION,
            updates=updates,
            success=letter in "sS",
            reached=letter in "sS",
            kicked_over=False,
            collision=False,
            active=1.0,
            began=0.0,
            ended=1.0,
        )
        for number, letter in enumerate(said, 1)
    ]


@pytest.mark.parametrize(
    ("said", "passed"),
    [
        ("", None),
        ("s", None),
        ("ss", True),
        ("sffs", True),
        ("sfffs", None),
        ("sSSSf", None),
        ("sFFFFs", True),
        ("ffffff", False),
        ("fffffs", False),
        ("ffffss", True),
    ],
)
def test_a_training_ends_with_enough_successes_among_the_last_that_were_led(said, passed):
    assert trained(attempts(said), RULE, 60.0) is passed


def test_a_training_that_takes_too_long_is_failed_but_not_one_that_is_passed_then():
    assert trained(attempts("s"), RULE, 1799.0) is None
    assert trained(attempts("s"), RULE, 1800.0) is False
    assert trained(attempts("ss"), RULE, 1800.0) is True


@pytest.mark.parametrize(
    ("said", "updates", "passed"),
    [
        ("", 0, None),
        ("S", 0, True),
        ("F", 0, None),
        ("F", 1, None),
        ("F", 2, False),
        ("S", 2, True),
        ("Fs", 2, None),
        ("Fff", 0, None),
        ("Ffff", 0, False),
        ("FffsF", 1, None),
        ("FffsFf", 1, None),
        ("sss", 0, None),
    ],
)
def test_a_model_is_adapted_once_the_robot_alone_succeeds_and_is_not_once_all_was_used(said, updates, passed):
    assert adapted(attempts(said, updates), TASK) is passed


@pytest.mark.parametrize(
    ("said", "lasted", "stands"),
    [
        ("", 0.0, Standing(0, 0, 1800.0)),
        ("sfS", 90.0, Standing(2, 1, 1710.0)),  # the robot alone did not practise
        ("sffff", 600.0, Standing(5, 0, 1200.0)),
        ("f", 2000.0, Standing(1, 0, 0.0)),
    ],
)
def test_how_a_training_stands_is_said_by_what_ends_it(said, lasted, stands):
    assert standing(attempts(said), RULE, lasted) == stands
