"""What is worth drawing: what is new, and what stays as it is only now and then."""

from protocol.messages import Light, TeachingState
from protocol.topics import TEACHING_STATE
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.viewer.news import Changes, News

SECOND = 1_000_000_000


def test_a_message_is_news_once_and_again_after_the_repeat():
    network = MemoryNetwork(ManualClock())
    bus = network.bus()
    news = News(bus.subscribe(TEACHING_STATE), repeat_s=1.0)
    bus.publish(TEACHING_STATE, TeachingState(phase="watch", text="", light=Light.RED))
    taken = [news.take(round(t * SECOND)) is not None for t in (0.0, 0.5, 1.1, 1.2)]
    assert taken == [True, False, True, False]


def test_a_value_is_due_when_it_changed_or_stayed_long():
    changes = Changes(repeat_s=1.0)
    times = ((1, 0.0), (1, 0.5), (2, 0.6), (2, 1.5), (2, 1.7))
    assert [changes.due("a", value, round(t * SECOND)) for value, t in times] == [True, False, True, False, True]


def test_subjects_do_not_know_each_other():
    changes = Changes(repeat_s=1.0)
    assert changes.due("a", 1, 0)
    assert changes.due("b", 1, 0)
