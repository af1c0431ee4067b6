"""What the viewer says in words."""

import msgspec

from protocol.messages import Light, Mode, Phase, Pose, RobotState, TeachingState, Verdict, Way
from services.bus.arrays import motion_to_wire
from services.viewer.journal import Journal
from tests.services.predictions import prediction

HERE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
SECOND = 1_000_000_000


def robot(phase, reason=""):
    return RobotState(measured=HERE, reference=HERE, phase=phase, mode=Mode.REFINE, episode=2, hold_reason=reason)


def said(journal, *states):
    """What is said of (time [s], state), each until the next."""
    return [entry for time_s, state in states for entry in journal.robot(state, round(time_s * SECOND))]


def test_a_phase_is_said_once():
    ramp, execute = robot(Phase.RAMP), robot(Phase.EXECUTE)
    entries = said(Journal(), (0.0, ramp), (1.0, ramp), (2.0, execute), (2.5, execute), (3.0, execute))
    assert [entry.text for entry in entries] == ["robot: ramp, episode 2", "robot: execute, episode 2"]


def test_a_hold_is_said_with_its_reason():
    (held,) = said(Journal(), (0.0, robot(Phase.HOLD, "no hand on the master")))
    assert held.text == "robot: hold, episode 2: no hand on the master"


def test_holds_of_a_moment_are_counted_and_said_when_the_robot_settles():
    journal = Journal()
    said(journal, (0.0, robot(Phase.EXECUTE)))
    flicker = [(0.2 * i, robot((Phase.HOLD, Phase.EXECUTE)[i % 2])) for i in range(1, 21)]
    assert said(journal, *flicker) == []
    entries = said(journal, (4.2, robot(Phase.HOLD)), (4.5, robot(Phase.HOLD)), (4.7, robot(Phase.HOLD)))
    assert [entry.text for entry in entries] == ["robot: hold, episode 2 (after 9 changes of a moment)"]


def test_holds_that_come_again_and_again_are_said_once():
    journal = Journal()
    states = [(0.1 * i, robot((Phase.EXECUTE, Phase.HOLD)[i // 8 % 2])) for i in range(600)]
    entries = said(journal, *states, *((60.0 + 0.1 * i, robot(Phase.HOLD)) for i in range(40)))
    assert [entry.text for entry in entries] == [
        "robot: execute, episode 2",
        "robot: hold, episode 2",
    ]


def test_what_comes_back_and_stays_is_said_again_with_how_often_it_was_not():
    journal = Journal()
    said(journal, *((0.1 * i, robot((Phase.EXECUTE, Phase.HOLD)[i // 8 % 2])) for i in range(160)))
    entries = said(journal, *((16.0 + 0.1 * i, robot(Phase.EXECUTE)) for i in range(40)))
    assert [entry.text for entry in entries] == ["robot: execute, episode 2 (after 9 changes of a moment)"]


def test_a_hold_long_after_another_one_is_said_as_soon():
    journal = Journal()
    for start in (0.0, 20.0):
        said(journal, (start, robot(Phase.EXECUTE)), (start + 5.0, robot(Phase.EXECUTE)))
        entries = said(journal, (start + 6.0, robot(Phase.HOLD)), (start + 6.6, robot(Phase.HOLD)))
        assert [entry.text for entry in entries] == ["robot: hold, episode 2"]


def test_a_stop_is_said_at_once_and_as_an_error():
    journal = Journal()
    said(journal, (0.0, robot(Phase.EXECUTE)))
    (stopped,) = said(journal, (0.1, robot(Phase.STOPPED)))
    assert stopped == ("robot: stopped, episode 2", "ERROR")


def test_after_a_stop_the_next_phase_is_said_again():
    journal = Journal()
    said(journal, (0.0, robot(Phase.EXECUTE)), (0.1, robot(Phase.STOPPED)))
    entries = said(journal, (1.0, robot(Phase.EXECUTE)), (2.0, robot(Phase.EXECUTE)))
    assert [entry.text for entry in entries] == ["robot: execute, episode 2"]


def test_a_verdict_says_what_changed_only():
    journal = Journal()
    list(journal.verdict(Verdict(reached=False, kicked_over=False, collision=False), 0))
    (entry,) = journal.verdict(Verdict(reached=False, kicked_over=False, collision=True, collision_force=31.4), 1)
    assert entry == ("collision, 31 N", "ERROR")


def test_what_is_known_of_a_prediction_is_said_once_and_little_of_it_as_a_warning():
    journal = Journal()
    sure = prediction(motion_to_wire([[0.0] * 3, [1.0] * 3], [[1.0, 0.0, 0.0, 0.0]] * 2, 1.0))
    unsure = msgspec.structs.replace(sure, known=0.2, way=Way(0, 2, 0.6))
    entries = [entry for one in (sure, sure, unsure, unsure) for entry in journal.prediction(one)]
    assert entries == [
        ("prediction of model version 1: 100 % known", "INFO"),
        ("prediction of model version 1: 20 % known, way 1 of 2, 60 %", "WARN"),
    ]


def teaching(text):
    return TeachingState(phase="watch", text=text, light=Light.RED)


def test_teaching_is_said_in_its_own_words_at_once():
    journal = Journal()
    entries = [entry for i, text in enumerate("abc") for entry in journal.teaching(teaching(text), i)]
    assert [entry.text for entry in entries] == ["watch: a", "watch: b", "watch: c"]


def test_a_sentence_that_comes_and_goes_is_said_once():
    journal = Journal()
    entries = [
        entry
        for i in range(600)
        for entry in journal.teaching(teaching(("watch", "paused")[i // 5 % 2]), i * SECOND // 10)
    ]
    assert [entry.text for entry in entries] == ["watch: watch", "watch: paused"]
