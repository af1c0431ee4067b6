"""Whatever a client sends and whatever breaks below, the robot's process goes on, stands, and says why."""

import logging
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol import messages, queries, topics
from protocol.messages import Mode, Phase
from protocol.queries import EpisodeStarted, Refused
from services.bus.arrays import motion_to_wire
from tests.services.predictions import announce
from tests.services.robot.site import IDENTITY, Site

EXTREMES = st.sampled_from([0.0, 0.1, -0.1, 1e-320, 1e9, -1e9, 1.7e308, -1.7e308, math.nan, math.inf, -math.inf])
WIRE = st.sampled_from([0.0, 0.1, -0.1, 1e-320, 1e9, -1e9])


@pytest.fixture
def site():
    site = Site()
    site.acquire()
    return site


class Broken(RuntimeError):
    """What a driver might raise."""


def breaks(site, monkeypatch, method, reason="cable\nloose"):
    def fail(*args):
        raise Broken(reason)

    monkeypatch.setattr(site.arm._backend, method, fail)


@pytest.mark.parametrize("method", ["command", "elapse", "observe"])
@pytest.mark.parametrize("mode", Mode)
def test_a_fault_of_the_backend_stops_the_arm_and_says_so(site, monkeypatch, caplog, method, mode):
    site.execute(mode)
    site.run(0.8, master=(0.0, 0.0, 0.0))
    breaks(site, monkeypatch, method)
    site.run(1.0, master=(0.0, 0.0, 0.0))
    assert site.state.phase is Phase.STOPPED
    assert (site.safety.emergency_stop, site.safety.by) == (True, "robot")
    assert site.safety.reason == "the arm failed (Broken: cable loose)"
    assert not site.result.completed
    assert "cable loose" in site.result.reason
    assert [entry.message for entry in caplog.records if entry.levelno == logging.ERROR] == [site.safety.reason]


def test_an_arm_that_fails_while_it_stands_is_stopped_too(site, monkeypatch):
    breaks(site, monkeypatch, "observe")
    site.run(0.01)
    assert site.safety.by == "robot"


def test_an_arm_that_works_again_moves_after_release_and_request(site, monkeypatch):
    with monkeypatch.context() as broken:
        breaks(site, broken, "elapse")
        site.run(0.1)
        site.release()
        site.run(0.01)
        assert site.safety.emergency_stop, "it is broken still"
    site.release()
    site.run(0.5)
    assert not site.safety.emergency_stop
    site.acquire()
    site.execute()


def test_a_solver_that_gives_no_number_moves_nothing(site, monkeypatch):
    site.execute()
    site.run(0.8)
    before = site.state.q
    monkeypatch.setattr(
        site.arm._kinematics, "solve_step", lambda q, position, orientation, dt: (q * math.nan, q * math.nan)
    )
    site.run(0.1)
    assert site.state.q == before
    assert "inverse kinematics gave no number" in site.state.clamped


def test_a_request_at_which_the_robot_fails_is_refused_counted_and_logged(site, monkeypatch, caplog):
    breaks(site, monkeypatch, "reset", reason="x\n" * 4000)
    reply = site.ask(queries.RESET, queries.Reset(site.epoch))
    assert isinstance(reply, Refused)
    assert reply.reason.startswith("the robot failed at this request (Broken: x x")
    assert "\n" not in reply.reason
    assert {f.name: f.value for f in site.service.figures()}["refused"] == 1.0
    assert any("the robot failed" in entry.message for entry in caplog.records)
    site.execute()


@given(st.lists(st.tuples(EXTREMES, EXTREMES, EXTREMES), min_size=2, max_size=4), st.floats(1e-6, 3600.0))
def test_no_motion_that_can_cross_the_wire_breaks_the_robot(positions, duration):
    site = Site()
    site.acquire()
    motion = motion_to_wire(np.array(positions), np.tile(IDENTITY, (len(positions), 1)), 1.0)
    asked = queries.Execute(site.epoch, Mode.REFINE, announce(site.operator, motion), duration)
    reply = site.ask(queries.EXECUTE, asked)
    assert isinstance(reply, Refused | EpisodeStarted)
    if isinstance(reply, Refused):
        assert "failed at this request" not in reply.reason
    site.run(0.1, master=(1e9, -1e9, 1e9))
    assert np.all(np.isfinite(site.state.q))
    assert not site.safety.emergency_stop


@given(
    st.one_of(st.none(), st.lists(WIRE, max_size=64).map(tuple)),
    st.one_of(st.none(), st.tuples(WIRE, WIRE, WIRE)),
    st.one_of(st.none(), st.just(""), st.text(max_size=64)),
    st.one_of(st.none(), st.tuples(WIRE, WIRE, WIRE)),
)
def test_no_reset_that_can_cross_the_wire_breaks_the_robot(condition, place, variant, start):
    site = Site()
    site.acquire()
    pose = None if start is None else messages.Pose(start, (0.0, 1.0, 0.0, 0.0))
    request = queries.Reset(site.epoch, variant, object_position=place, condition=condition, start=pose)
    reply = site.ask(queries.RESET, request)
    assert reply is not None
    assert "failed at this request" not in getattr(reply, "reason", "")
    assert not site.safety.emergency_stop


@given(st.tuples(WIRE, WIRE, WIRE), st.tuples(WIRE, WIRE, WIRE))
def test_no_master_state_breaks_the_robot_or_takes_it_beyond_its_reach(displacement, rotation):
    site = Site()
    site.acquire()
    site.execute(Mode.REFINE)
    site.run(0.6, master=(0.0, 0.0, 0.0))
    for _ in range(20):
        state = messages.MasterState(
            displacement=displacement, rotation=rotation, engaged=True, holder="ann", epoch=site.epoch
        )
        site.operator.publish(topics.MASTER_STATE, state)
        site.run(0.01)
    assert np.linalg.norm(site.state.offset) <= 0.3 * (1.0 + 1e-6)
    assert np.linalg.norm(site.state.turn) <= 1.0 * (1.0 + 1e-6)
    assert not site.safety.emergency_stop


def test_what_counts_as_latency_ends_with_the_command(site, monkeypatch):
    """Not with the physics after it."""
    elapse = site.arm._backend.elapse

    def slow():
        site.clock.advance(0.004)
        elapse()

    monkeypatch.setattr(site.arm._backend, "elapse", slow)
    site.execute(Mode.REFINE)
    site.run(1.0, master=(0.0, 0.0, 0.0))
    assert site.state.applied_latency == pytest.approx(0.0)
    assert {f.name: f.value for f in site.service.figures()}["sample_to_command_p99"] == pytest.approx(0.0)
