"""People can look at what passes and at who lives on a network."""

import re

import msgpack
import pytest

from protocol import topics
from protocol.messages import OperatorInput
from tests.system.harness import Command, Witness, eventually
from tests.system.stranger import Stranger

pytestmark = [pytest.mark.system, pytest.mark.zenoh]

WITHIN_S = 10.0


def test_echo_prints_what_strangers_and_newer_versions_send(tmp_path, router):
    newer = {"engaged": True, "epoch": 7, "colour": "of the next version"}
    printed = {
        "cmd/else [?] {temperature: 21.5, unit: 'C'}": (msgpack.packb({"temperature": 21.5, "unit": "C"}), ""),
        "cmd/else [?] b'\\xc1 no msgpack'": (b"\xc1 no msgpack", ""),
        "cmd/else [MasterState/2] {engaged: True, epoch: 7, colour: 'of the next version'}": (
            msgpack.packb(newer),
            "MasterState/2",
        ),
    }
    with (
        Command("echo", "retouch/@v1/robot1/cmd/**", "--connect", router, folder=tmp_path) as echo,
        Stranger(router) as stranger,
    ):
        for line, (payload, schema) in printed.items():

            def shown(line=line, payload=payload, schema=schema):
                stranger.put("retouch/@v1/robot1/cmd/else", payload, schema)
                return line in echo.out

            echo.until(shown, WITHIN_S, line)
        echo.process.terminate()
        assert echo.ended(WITHIN_S) == 0
    assert echo.err == ""


def test_echo_ends_after_as_many_messages_as_asked_for(tmp_path, router):
    with (
        Command("echo", "**", "--count", "2", "--connect", router, folder=tmp_path) as echo,
        Stranger(router) as stranger,
    ):

        def ended():
            stranger.put("some/key", msgpack.packb(1))
            return echo.process.poll() is not None

        eventually(ended, WITHIN_S, "it ends")
    assert echo.out.count("some/key") == echo.out.count("\n") == 2


def test_top_shows_the_live_processes_with_rate_age_latency_and_drops(tmp_path, bus, router):
    with (
        Command("model", "--connect", router, folder=tmp_path),
        Command("master", "--connect", router, folder=tmp_path) as master,
        Witness(router) as witness,
        Stranger(router) as stranger,
    ):
        witness.next_beats({"model", "master"}, 30.0)

        station = bus("station")

        def counted():
            stranger.put(topics.OPERATOR_INPUT.key("robot1", "stranger"), b"\xc1")
            station.publish(topics.OPERATOR_INPUT, OperatorInput())
            beat = witness.beats()["master"]
            figures = next(t for t in beat.topics if t.topic == topics.OPERATOR_INPUT.name)
            return figures.malformed and figures.latency >= 0.0

        eventually(counted, WITHIN_S, "a drop and a latency are told")
        with Command("top", "--once", "--connect", router, folder=tmp_path) as top:
            assert top.ended(20.0) == 0
        for heading in ("process", "Hz", "rate", "age", "latency", "drops", "CPU", "late"):
            assert heading in top.out
        (row,) = (line for line in top.out.splitlines() if topics.OPERATOR_INPUT.name in line)
        assert f":{master.process.pid}" in row
        cells = [cell.strip() for cell in row.strip("│┃ ").split("│")]
        assert int(cells[-1]) > 0
        assert cells[-2].endswith("ms")
        assert cells[-3].endswith("ms")
        assert re.search(r"robot1\s*│\s*model", top.out)
