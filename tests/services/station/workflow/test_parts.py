"""Of a refinement that failed or was stopped the part before that is learnt, where the operator says so."""

import msgspec
import numpy as np
import pytest

from protocol import queries
from protocol.messages import Cut, Outcome, Part
from services.bus.arrays import motion_from_wire, motion_to_wire
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from services.station.workflow.verdict import MARGIN
from tests.services.station.workflow.site import (
    BY_HAND,
    COLLIDED,
    MISSED,
    REACHED,
    RELEASED,
    SCRIPTED,
    STOPPED,
    Site,
)

LEARN = "model/add_demonstration"
KICKED = Outcome(reached=True, kicked_over=True, collision=False)
N = 31
LOOKED = (0.85, 0.05, 0.5)


def commanded(progress):
    """Along x as far as the phase, in the time that a refinement takes."""
    x = np.linspace(0.0, progress, N)
    return motion_to_wire(np.column_stack([x, x, x]), np.tile([1.0, 0.0, 0.0, 0.0], (N, 1)), 20.0 * progress)


def failed(outcome, progress=1.0, clear_until=1.0, *, finishing=False, settings=BY_HAND, **changes):
    site = Site(settings, [COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.EXECUTING)
    if finishing:
        site.step(Action.FINISH)
    changes = {"progress": progress, "clear_until": clear_until, "commanded": commanded(progress), **changes}
    site.end(outcome, **changes)
    site.run_to(Phase.DECIDING)
    site.step()
    return site


FINISHED = {"completed": False, "cut": Cut.FINISHED, "reason": "finished by ann at 60 %", "finishing": True}
CUT = {"completed": False, "cut": Cut.STOPPED, "reason": "the robot comes within 3 mm of itself"}


@pytest.mark.parametrize(
    ("outcome", "progress", "clear_until", "changes"),
    [
        (COLLIDED, 1.0, 0.6, {}),
        (KICKED, 1.0, 0.6, {}),
        (COLLIDED, 0.8, 0.6, FINISHED),
        (MISSED, 0.6, 0.6, FINISHED),
        (MISSED, 0.6, 0.6, CUT),
        (REACHED, 0.6, 0.6, CUT),
    ],
    ids=["collided", "kicked over", "collided, then finished", "given up", "stopped", "stopped at the object"],
)
def test_what_came_before_the_failure_is_learnt_only_upon_a_press(outcome, progress, clear_until, changes):
    site = failed(outcome, progress, clear_until, **changes)
    assert site.stay(60) == []
    assert LEARN not in site.names()
    assert Action.TEACH in site.state.offered
    site.step(Action.TEACH)
    site.run_to(Phase.DECIDING)
    (asked,) = site.requests(queries.ADD_DEMONSTRATION)
    assert (asked.part.first, asked.part.last) == (0.0, pytest.approx(0.6 - MARGIN))
    assert "up to 55 % of the motion" in site.state.event


@pytest.mark.parametrize(("progress", "changes"), [(1.0, {}), (0.8, FINISHED)])
def test_the_motion_that_is_learnt_has_the_predictions_phases_and_an_autonomous_tempo(progress, changes):
    site = failed(COLLIDED, progress, 0.6, **changes)
    site.step(Action.TEACH)
    site.run_to(Phase.DECIDING)
    (asked,) = site.requests(queries.ADD_DEMONSTRATION)
    positions, _, duration, _ = motion_from_wire(asked.motion)
    phases = np.linspace(0.0, 1.0, N)
    np.testing.assert_allclose(positions[:, 0], np.minimum(phases, progress), atol=1e-12)
    assert duration == BY_HAND.autonomous_s


@pytest.mark.parametrize(
    ("outcome", "changes"),
    [
        (MISSED, {}),
        (COLLIDED, {"clear_until": 0.6, "operator_input": False}),
        (COLLIDED, {"clear_until": 0.14}),
        (MISSED, {"progress": 0.1, "clear_until": 0.1, **CUT}),
        (COLLIDED, {**CUT, "clear_until": 0.6, "cut": Cut.TAKEN_OVER}),
        (MISSED, {**FINISHED, "progress": 0.6, "clear_until": 0.6, "finishing": False}),
    ],
    ids=["missed", "uncorrected", "too early", "stopped too early", "taken over", "finished elsewhere"],
)
def test_where_nothing_is_known_to_have_been_right_nothing_is_offered(outcome, changes):
    site = failed(outcome, **changes)
    assert Action.TEACH not in site.state.offered
    assert LEARN not in site.names()


@pytest.mark.parametrize(
    ("outcome", "changes", "why"),
    [
        (MISSED, {}, "Where it went wrong is not known"),
        (COLLIDED, {"clear_until": 0.6, "operator_input": False}, "No correction of yours counted"),
        (COLLIDED, {**FINISHED, "progress": 0.6, "clear_until": 0.14}, "It failed at 14 % of the motion: too little"),
        (MISSED, {"progress": 0.1, "clear_until": 0.1, **CUT}, "It failed at 10 % of the motion: too little"),
    ],
)
def test_where_nothing_can_be_taught_the_operator_is_told_why(outcome, changes, why):
    assert why in failed(outcome, **changes).state.event


@pytest.mark.parametrize(("outcome", "changes"), [(COLLIDED, {"clear_until": 0.6}), (REACHED, {})])
def test_where_something_can_or_was_no_reason_is_told(outcome, changes):
    event = failed(outcome, **changes).state.event
    assert "teach" not in event
    assert "taught" not in event


def test_numbers_that_no_robot_sends_are_not_offered():
    nowhere = motion_to_wire(np.full((N, 3), np.nan), np.tile([1.0, 0.0, 0.0, 0.0], (N, 1)), 12.0)
    site = failed(MISSED, 0.6, 0.6, **CUT, commanded=nowhere)
    assert Action.TEACH not in site.state.offered


def test_a_part_that_was_not_taught_is_dropped_by_the_next_episode():
    site = failed(COLLIDED, 1.0, 0.6)
    site.step(Action.REFINE)
    assert site.state.taught is None


@pytest.mark.parametrize("told_first", [False, True], ids=["stop first", "result first"])
def test_after_an_emergency_stop_and_its_release_the_operator_is_asked(told_first):
    """Whichever comes first, the stop's state or the result; it is learnt for where the object stood then."""
    site = Site(BY_HAND, [COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.EXECUTING)
    if not told_first:
        site.sees(safety=STOPPED)
        site.step()
    site.sees(safety=STOPPED)
    site.end(MISSED, progress=0.6, clear_until=0.6, commanded=commanded(0.6), **CUT)
    site.step()
    moved = msgspec.structs.replace(site.view.seen.pose, position=(0.9, 0.1, 0.5))
    site.sees(safety=RELEASED, seen=msgspec.structs.replace(site.view.seen, pose=moved))
    site.run_to(Phase.DECIDING)
    assert site.stay() == []
    assert Action.TEACH in site.state.offered
    site.step(Action.TEACH)
    site.run_to(Phase.DECIDING)
    (asked,) = site.requests(queries.ADD_DEMONSTRATION)
    assert (asked.object_position, asked.part.last) == (LOOKED, pytest.approx(0.6 - MARGIN))
    assert site.state.looked == (0.9, 0.1, 0.5)


def test_a_script_teaches_no_part_of_what_failed():
    site = Site(SCRIPTED, [COLLIDED])
    while site.state.mode.value != "refine" or site.state.phase is not Phase.EXECUTING:
        site.step()
    site.end(COLLIDED, clear_until=0.6, commanded=commanded(1.0))
    site.verdicts = [REACHED, REACHED]
    site.run_to(Phase.FINISHED)
    (asked,) = site.requests(queries.ADD_DEMONSTRATION)
    assert asked.part == Part()
