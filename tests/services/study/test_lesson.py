"""A synthetic participant teaches through the real services: the same from the same seed, by the protocol's rules."""

import msgspec
import pytest

from services.offline.first_demonstrations import first_demonstrations
from services.study.protocol.protocol import Task, Training, load
from services.study.protocols import SHIPPED
from services.study.synthetic.character import Nature
from services.study.synthetic.lesson import Lesson, given
from services.study.synthetic.run import arrangement
from sim.tasks import PARTICLE

pytestmark = pytest.mark.sim

PROTOCOL = msgspec.structs.replace(
    load(SHIPPED["thesis"]), task=Task("particle", models=1), training=Training(successes=1, of_last=2)
)


def lesson(seed):
    return Lesson(
        participant=1,
        nature=Nature.drawn(seed),
        method=PROTOCOL.method("OnKey"),
        place=1,
        task=PROTOCOL.task,
        training=PROTOCOL.training,
        demonstrations=tuple(first_demonstrations(PARTICLE)),
        arrangement=arrangement(PROTOCOL, PARTICLE),
    )


@pytest.fixture(scope="module")
def parts():
    return given(lesson(3))


def test_the_training_ends_with_enough_successes_and_the_model_with_the_robot_alone(parts):
    training, model = parts
    assert (training.part, model.part) == ("OnKey/training", "OnKey/1")
    led = [attempt.success for attempt in training.attempts if attempt.teaching is not None]
    assert training.passed
    assert led[-1]
    assert model.passed
    assert model.attempts[-1].teaching is None
    assert model.attempts[-1].success
    assert model.attempts[-1].updates >= 1


def test_the_first_model_is_tried_before_it_is_taught_and_time_counts_only_while_it_is(parts):
    model = parts[1]
    assert model.attempts[0].teaching is None
    assert not model.attempts[0].success
    assert all((attempt.active > 0.0) == (attempt.teaching is not None) for attempt in model.attempts)
    assert model.seconds == pytest.approx(sum(attempt.active for attempt in model.attempts))


def test_the_same_seed_does_the_same_and_another_one_something_else(parts):
    assert given(lesson(3)) == parts
    assert given(lesson(4)) != parts
