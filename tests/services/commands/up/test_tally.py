"""What executions of a skill come to: how many succeeded, how sure that is, why others failed, how long they took."""

import msgspec
import pytest

from protocol.messages import Attempt, Mode, Outcome
from services.commands.up.report import faults_of
from services.commands.up.tally import Tally

REACHED, MISSED, HIT = (
    Outcome(reached, False, collision) for reached, collision in ((True, False), (False, False), (False, True))
)


def tally(*outcomes, asked=None, reason=""):
    attempts = [
        Attempt("table", (0.8, 0.0, 0.5), 3, False, one, 10.0 + i, "moved", Mode.AUTONOMOUS)
        for i, one in enumerate(outcomes)
    ]
    return Tally.of("cups", asked or len(outcomes), [(one, faults_of(one)) for one in attempts], reason)


def test_successes_have_their_interval_and_failures_their_reasons_the_most_frequent_first():
    found = tally(REACHED, HIT, HIT, MISSED, REACHED)
    assert (found.executed, found.successes, found.complete) == (5, 2, True)
    assert found.interval == pytest.approx((0.1176, 0.7693), abs=1e-3)
    assert found.failures == {"collision, not reached": 2, "not reached": 1}
    assert (found.shortest_s, found.mean_s, found.longest_s) == (10.0, 12.0, 14.0)


def test_for_people_it_is_a_few_lines():
    lines = list(tally(REACHED, HIT).lines())
    assert lines[0] == "skill cups: 1 of 2 succeeded, 50.0 %, 95 % interval 9 to 91 %"
    assert lines[1] == "1 failed: collision, not reached"
    assert "10.0 to 11.0 s" in lines[2]


def test_fewer_than_asked_for_say_why():
    found = tally(REACHED, asked=3, reason="stopped by anna")
    assert not found.complete
    assert list(found.lines())[-1] == "1 of 3 were executed: stopped by anna"


def test_one_that_was_cut_short_is_no_failure_of_the_skill():
    cut = Attempt("table", (0.8, 0.0, 0.5), 3, False, MISSED, 3.4, "moved", Mode.AUTONOMOUS, completed=False)
    whole = msgspec.structs.replace(cut, verdict=REACHED, completed=True)
    found = Tally.of("cups", 5, [(one, faults_of(one)) for one in (whole, cut)], "stopped by anna")
    assert (found.executed, found.cut_short, found.successes, found.failures) == (1, 1, 1, {})
    assert "1 cut short" in "\n".join(found.lines())


def test_none_at_all_is_told_without_a_figure_that_nobody_measured():
    found = tally(asked=3, reason="the authority was lost")
    assert (found.executed, found.interval, found.mean_s) == (0, (0.0, 1.0), 0.0)
    assert [line for line in found.lines() if "each took" in line] == []
