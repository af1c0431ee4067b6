"""What is told of a run."""

import pytest

from protocol.messages import Attempt, Mode, Outcome
from services.commands.up.report import attempt_line

MISSED = Outcome(reached=False, kicked_over=False, collision=False)


@pytest.mark.parametrize(
    ("condition", "target"),
    [((), "object at (0.850, 0.050, 0.500) m"), ((0.1, -0.05), "condition (0.100, -0.050) m")],
)
def test_an_attempt_is_told_in_one_line_with_its_target(condition, target):
    attempt = Attempt("s", (0.85, 0.05, 0.5), 3, False, MISSED, 10.5, "b2", Mode.AUTONOMOUS, condition)
    assert attempt_line(2, attempt) == f"2. prediction of model version 3 in s b2, {target}: not reached, 10.5 s"
