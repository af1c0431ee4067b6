"""What is made of a run that was heard: a hand's samples are counted anew, and an arm is put back, without any harm."""

import msgspec
import pytest

from protocol import topics
from protocol.codec import encode
from protocol.messages import MasterState, Mode, Phase
from tests.network.link import AHEAD_S
from tests.network.record import Record
from tests.services.robot.site import Site

SECOND = 1_000_000_000


def state(at_s, phase, sequence=0, episode=1, x=0.0):
    site = Site()
    site.run(0.01)
    base = site.state
    measured = msgspec.structs.replace(base.measured, position=(x, 0.0, 0.0))
    changed = {"mode": Mode.REFINE, "phase": phase, "applied_sequence": sequence, "episode": episode}
    said = msgspec.structs.replace(base, stamp_ns=round(at_s * SECOND), measured=measured, **changed)
    return said.stamp_ns, topics.ROBOT_STATE.name, encode(topics.ROBOT_STATE, said)


def sample(at_s, sequence, publisher):
    stamp_ns = round((at_s + AHEAD_S) * SECOND)
    said = MasterState(publisher=publisher, sequence=sequence, stamp_ns=stamp_ns)
    return round(at_s * SECOND), topics.MASTER_STATE.name, encode(topics.MASTER_STATE, said)


def test_a_hold_counts_from_the_sample_of_the_process_that_moved_the_robot_last():
    heard = [sample(1.0, 7, publisher=1), sample(9.0, 7, publisher=2)]
    heard += [state(9.05, Phase.EXECUTE, 7), state(9.1, Phase.HOLD, 7)]
    figures = Record(heard, []).figures()
    assert figures.hold_after_ms == pytest.approx(100.0)
    assert figures.oldest_ms == pytest.approx(50.0)


def test_an_arm_that_is_put_back_between_two_motions_did_not_move_in_a_hold():
    heard = [state(1.0 + 0.1 * tick, Phase.HOLD, x=0.0) for tick in range(6)]
    heard += [state(1.7, Phase.IDLE, x=0.3)]
    heard += [state(1.8 + 0.1 * tick, Phase.HOLD, episode=2, x=0.3) for tick in range(6)]
    assert Record(heard, []).figures().unasked_mm == 0.0


def test_an_arm_that_moves_in_a_hold_is_seen():
    heard = [state(1.0 + 0.1 * tick, Phase.HOLD, x=0.01 * tick) for tick in range(6)]
    assert Record(heard, []).figures().unasked_mm == pytest.approx(10.0)
