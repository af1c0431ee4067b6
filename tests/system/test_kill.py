"""kill -9 of anything, at any time: the robot holds, the process returns, nothing acknowledged is lost."""

import json
import os
import signal

import numpy as np
import pytest

from protocol import queries, topics
from protocol.messages import Mode, Purpose
from services.bus.arrays import motion_to_wire
from tests.system.harness import (
    EVERYBODY,
    START_S,
    Command,
    Witness,
    configured,
    eventually,
    free_endpoint,
)
from tests.system.supervised import BACK_S, EPISODE_S, Run

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.alone]

PROMISED_S = 2.0
KERNEL_S = 1.0
"""For the end of a process to be seen, on a machine that is busy with something else too."""


@pytest.mark.sim
def test_each_process_is_killed_in_turn_and_the_loop_still_closes(tmp_path):
    endpoint = free_endpoint()
    configuration = configured(tmp_path, endpoint, robot="lease_s = 0.5")
    arguments = ("--fresh", "--headless", "--once", "--json", "out.json", "--config", configuration)
    with Command("up", *arguments, folder=tmp_path) as up, Witness(endpoint) as witness:
        run = Run(up, witness)
        run.executing(Mode.AUTONOMOUS)
        first = up.pids()
        assert set(first) >= EVERYBODY

        epoch = witness.next(topics.AUTHORITY_STATE).epoch
        run.kill("station")
        run.holds("nobody holds the authority")
        run.back("station", first["station"])
        witness.next(topics.AUTHORITY_STATE, lambda state: state.epoch > epoch + 1, BACK_S)

        run.executing(Mode.AUTONOMOUS)
        run.kill("robot")
        run.back("robot", first["robot"])

        run.executing(Mode.AUTONOMOUS)
        run.kill("router")
        run.back("router", first["router"])
        assert witness.next_beats(EVERYBODY - {"router"}, BACK_S), "everybody speaks again"
        for name in ("viewer", "camera", "perception"):
            run.kill(name)
            run.back(name, first[name])

        run.executing(Mode.REFINE)
        run.kill("master")
        run.holds("keys or device were not heard")
        run.back("master", first["master"])

        up.until(lambda: (state := witness.teaching) and state.updates, 2 * EPISODE_S, "a refinement is learnt")
        learnt = witness.asked(queries.DESCRIBE, queries.Describe()).state
        run.kill("model")
        run.back("model", first["model"])
        kept = witness.asked(queries.DESCRIBE, queries.Describe()).state
        assert kept.version >= learnt.version
        assert kept.demonstrations >= learnt.demonstrations > 0
        assert kept.updates >= learnt.updates > 0

        assert up.ended(2 * EPISODE_S) == 0, up.tail()
        assert up.left() == []
    report = json.loads((tmp_path / "out.json").read_text())
    assert report["loop_closed"] is True
    assert {name for name, count in report["restarts"].items() if count} == EVERYBODY, "killed, and nothing else fell"
    assert not set(report["processes"].values()) & set(first.values())


@pytest.mark.parametrize("lives", [False, True], ids=["at once", "when all live"])
def test_nothing_survives_a_killed_supervisor(tmp_path, lives):
    endpoint = free_endpoint()
    configuration = configured(tmp_path, endpoint)
    with Command("up", "--fresh", "--headless", "--config", configuration, folder=tmp_path) as up:
        if lives:
            with Witness(endpoint) as witness:
                witness.next_beats(EVERYBODY - {"router"}, START_S)
        else:
            up.until(lambda: len(up.left()) > len(EVERYBODY), START_S, "the children are there")
        os.kill(up.process.pid, signal.SIGKILL)
        up.process.wait()
        # Who is only beginning ends when it comes to look.
        eventually(lambda: not up.left(), PROMISED_S + KERNEL_S if lives else START_S, "the children end")


def test_what_the_model_acknowledged_survives_its_kill(tmp_path, router):
    database = f'database = "{tmp_path / "model.sqlite"}"'
    configuration = configured(tmp_path, router, model=database)
    rng = np.random.default_rng(1)
    with Witness(router) as witness:
        for version in range(1, 4):
            with Command("model", "--config", configuration, folder=tmp_path) as model:
                before = witness.asked(queries.DESCRIBE, queries.Describe()).state
                assert (before.version, before.demonstrations) == (version - 1, version - 1)
                witness.asked(queries.ADD_DEMONSTRATION, demonstration(rng))
                model.process.kill()
        with Command("model", "--config", configuration, folder=tmp_path):
            assert witness.asked(queries.DESCRIBE, queries.Describe()).state.demonstrations == 3


def demonstration(rng):
    """A straight reach to some place."""
    place = rng.uniform((0.6, -0.2, 0.4), (0.8, 0.2, 0.6))
    positions = np.linspace((0.4, 0.0, 0.8), place, 75)
    orientations = np.tile((1.0, 0.0, 0.0, 0.0), (75, 1))
    motion = motion_to_wire(positions, orientations, 10.0)
    return queries.AddDemonstration(Purpose.INITIAL, motion, tuple(place.tolist()), "dishwasher")
