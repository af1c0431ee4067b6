"""What the viewer says in words, and what it finds worth drawing."""

from protocol.messages import Light, Mode, Phase, Pose, RobotState, TeachingState, Verdict
from protocol.topics import TEACHING_STATE
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.viewer.journal import Journal
from services.viewer.news import Changes, News

HERE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
SECOND = 1_000_000_000


def robot(phase, reason=""):
    return RobotState(measured=HERE, reference=HERE, phase=phase, mode=Mode.REFINE, episode=2, hold_reason=reason)


def test_a_phase_is_said_once():
    journal = Journal()
    said = [list(journal.robot(robot(phase))) for phase in (Phase.RAMP, Phase.RAMP, Phase.EXECUTE)]
    assert [len(entries) for entries in said] == [1, 0, 1]
    assert said[2][0].text == "robot: execute, episode 2"


def test_a_hold_is_said_with_its_reason_and_a_stop_as_an_error():
    journal = Journal()
    (held,) = journal.robot(robot(Phase.HOLD, "no hand on the master"))
    (stopped,) = journal.robot(robot(Phase.STOPPED))
    assert held.text == "robot: hold, episode 2: no hand on the master"
    assert stopped.level == "ERROR"


def test_a_verdict_says_what_changed_only():
    journal = Journal()
    list(journal.verdict(Verdict(reached=False, kicked_over=False, collision=False)))
    (entry,) = journal.verdict(Verdict(reached=False, kicked_over=False, collision=True, collision_force=31.4))
    assert entry == ("collision, 31 N", "ERROR")


def test_teaching_is_said_in_its_own_words():
    (entry,) = Journal().teaching(TeachingState(phase="watch", text="watch the robot", light=Light.RED))
    assert entry.text == "watch: watch the robot"


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
