"""kill -9 of every process in every phase of the teaching: it returns, no other falls, the teaching goes on."""

import os
import signal
from contextlib import contextmanager

import numpy as np
import pytest

from protocol import topics
from protocol.messages import EmergencyStop, Mode, Phase
from services.process.processes import PROCESS_NAMES
from tests.system.harness import EVERYBODY, START_S, Command, Witness, configured, eventually, free_endpoint
from tests.system.supervised import BACK_S, EPISODE_S, Run

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone, pytest.mark.long]

STILL_RAD = 1e-3
BEFORE_A_MOTION = {"resetting", "looking", "predicting", "starting"}


@contextmanager
def before_a_motion(run):
    """The object is looked for, a motion is predicted."""
    run.up.until(
        lambda: run.witness.teaching and run.witness.teaching.phase in BEFORE_A_MOTION, EPISODE_S, "it prepares"
    )
    yield


@contextmanager
def autonomous(run):
    """A prediction is executed."""
    run.executing(Mode.AUTONOMOUS)
    yield


@contextmanager
def refined(run):
    """A prediction is executed and corrected."""
    run.executing(Mode.REFINE)
    yield


@contextmanager
def held(run):
    """An execution is corrected no more, because the master sleeps: the robot holds."""
    run.executing(Mode.REFINE)
    master = run.up.pids()["master"]
    os.kill(master, signal.SIGSTOP)
    try:
        run.holds("were not heard")
        yield
    finally:
        if run.up.pids().get("master") == master:
            os.kill(master, signal.SIGCONT)


@contextmanager
def running(folder, *arguments):
    """A supervised run; nothing of it fails but by being killed."""
    endpoint = free_endpoint()
    times = "autonomous_s = 4.0\nrefine_s = 8.0"
    configuration = configured(folder, endpoint, robot="lease_s = 0.5", station=times)
    with (
        Command("up", "--fresh", *arguments, "--config", configuration, folder=folder) as up,
        Witness(endpoint) as witness,
    ):
        yield Run(up, witness)
        assert "Traceback" not in up.out + up.err


def speaking(run):
    """The process ids of all, once each of them speaks."""
    run.up.until(lambda: run.up.pids().keys() >= EVERYBODY, START_S, "all live")
    run.witness.next_beats(PROCESS_NAMES, START_S)
    return run.up.pids()


def kill_in_turn(run, within):
    """kill -9 each process, router and all, within a phase; gives its name once it and all others are back."""
    for name in sorted(EVERYBODY):
        before, model = speaking(run), run.witness.next(topics.MODEL_STATE, within_s=BACK_S)
        with within(run):
            pid = run.kill(name)
            run.back(name, pid)
        after = speaking(run)
        assert {other for other in EVERYBODY if after[other] != before[other]} == {name}, "nothing else fell"
        kept = run.witness.next(topics.MODEL_STATE, within_s=BACK_S)
        assert (kept.version, kept.updates) >= (model.version, model.updates)
        yield name


@pytest.mark.parametrize("within", [before_a_motion, autonomous, refined, held])
def test_whoever_is_killed_returns_and_the_teaching_goes_on(tmp_path, within):
    with running(tmp_path, "--headless") as run:
        run.executing(Mode.AUTONOMOUS)
        killed = list(kill_in_turn(run, within))
        assert set(killed) == EVERYBODY
        run.executing(Mode.AUTONOMOUS)


@pytest.fixture
def run(tmp_path):
    """Waits for a person: a script ends at a stop."""
    with running(tmp_path, "--no-browser") as run:
        speaking(run)
        yield run


def test_a_latched_stop_outlives_whoever_is_killed(run):
    def latched():
        run.witness.bus.publish(topics.EMERGENCY_STOP, EmergencyStop(pressed=True, by="witness", reason="a test"))
        state = run.witness.next(topics.SAFETY_STATE)
        return state.emergency_stop and state.standing

    @contextmanager
    def stopped(run):
        assert run.witness.next(topics.SAFETY_STATE, within_s=BACK_S).emergency_stop
        yield

    eventually(latched, START_S, "the stop is latched, and the robot stands")
    q = run.witness.next(topics.ROBOT_STATE).q
    for name in kill_in_turn(run, stopped):
        state = run.witness.next(topics.SAFETY_STATE, within_s=BACK_S)
        assert (state.emergency_stop, state.by) == (True, "witness"), name
        robot = run.witness.next(topics.ROBOT_STATE)
        assert robot.phase is Phase.STOPPED
        if name != "robot":  # a simulated one begins where it began
            assert np.abs(np.subtract(robot.q, q)).max() < STILL_RAD, name
        q = robot.q
