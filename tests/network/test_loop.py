"""The loop closes over bad networks, and the robot keeps its promises meanwhile: see `cases`."""

import pytest

from tests.network.cases import CASES, LAN, run
from tests.network.link import Impossible

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.long]

HOLD_MS = 200.0
OLDEST_MS = 250.0
STILL_MM = 0.1


@pytest.mark.parametrize("case", [case for case in CASES if case is not LAN], ids=lambda case: case.name)
def test_the_loop_closes_and_nothing_stale_moves_the_robot(case):
    try:
        outcome = run(case)
    except Impossible as reason:
        pytest.skip(str(reason))
    assert outcome.closed, outcome.told
    assert outcome.figures.hold_after_ms <= HOLD_MS
    assert outcome.figures.oldest_ms <= OLDEST_MS
    assert outcome.figures.unasked_mm <= STILL_MM
    assert outcome.gone_mm <= STILL_MM
