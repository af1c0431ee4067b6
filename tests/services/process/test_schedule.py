"""Topics come at the rate of the registry, whatever the steps of a service are."""

import pytest

from protocol import topics
from services.process.schedule import Schedule

MS = 1_000_000


@pytest.mark.parametrize("topic", topics.TOPICS, ids=lambda topic: topic.name)
@pytest.mark.parametrize("step_ms", [1, 7, 10])
def test_a_topic_is_due_as_often_as_its_rate_says_and_the_steps_allow(topic, step_ms):
    schedule, seconds = Schedule(), 10
    times = range(0, seconds * 1000, step_ms)
    published = sum(schedule.due(topic, now * MS) for now in times)
    assert published == pytest.approx(min(seconds * topic.rate_hz, len(times)), rel=0.01, abs=1.0)


def test_the_first_time_is_now():
    assert Schedule().due(topics.SCENE_STATE, 123 * MS)


def test_what_was_missed_is_not_made_up_for_and_the_phase_stays():
    schedule = Schedule()
    assert schedule.due(topics.SCENE_STATE, 0)
    assert schedule.due(topics.SCENE_STATE, 3500 * MS)
    assert not schedule.due(topics.SCENE_STATE, 3999 * MS)
    assert schedule.due(topics.SCENE_STATE, 4000 * MS)
    assert not schedule.due(topics.SCENE_STATE, 4010 * MS)


def test_topics_are_due_each_by_itself():
    schedule = Schedule()
    assert schedule.due(topics.SCENE_STATE, 0)
    assert schedule.due(topics.MODEL_STATE, 0)
    assert not schedule.due(topics.SCENE_STATE, 10 * MS)
