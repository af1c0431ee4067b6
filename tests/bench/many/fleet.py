"""Robots, the router or two that join them with their operators, and what the robots' heartbeats say."""

import contextlib
import json
import subprocess
import sys
import threading
import time
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import psutil

from protocol import topics
from protocol.codec import decode
from protocol.topic import VERSION
from services.bus.zenoh import open_session, watch
from tests.system.harness import START_S, Command, eventually, free_endpoint, reachable

SETTLE_S = 2.0
"""After everybody moves, before anything is measured."""

BEATS = f"retouch/{VERSION}/*/{topics.HEARTBEAT.name}/robot"


@dataclass(frozen=True)
class Cost:
    """What robots took in an interval.

    Attributes:
        robots: how many there were.
        routers: between them and their operators.
        period_p50_ms: of the control periods, median over heartbeats.
        period_p99_ms: the same of the heartbeats' 99th percentiles.
        late: share of the control ticks that began more than half a period late.
        latency_p50_ms: from a hand's sample to the command that it shaped, median over heartbeats.
        latency_p99_ms: the same of the heartbeats' 99th percentiles.
        processor: of one robot, mean, cores.
        memory_mb: of one robot, shared pages parted among those who share them.
        routing: of all routers, cores.
        traffic: messages and bytes a second of all robots, by topic, as their operators heard them.
    """

    robots: int
    routers: int
    period_p50_ms: float
    period_p99_ms: float
    late: float
    latency_p50_ms: float
    latency_p99_ms: float
    processor: float
    memory_mb: float
    routing: float
    traffic: dict


class Stuck(Exception):
    """Not all robots of a fleet could be made to move; says what the last operator said."""


class Beats:
    """The robots' heartbeats, by robot, since the last call of `take`; a context manager.

    Args:
        endpoint: of a router.
    """

    def __init__(self, endpoint):
        self._session = open_session(endpoint, START_S)
        self._beats = defaultdict(list)
        self._exchange = threading.Lock()
        watch(self._session, BEATS, self._hear)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._session.close()

    def _hear(self, passing):
        beat = decode(topics.HEARTBEAT, passing.payload, passing.schema)
        with self._exchange:
            self._beats[beat.robot].append(beat)

    def take(self):
        """All since the last call."""
        with self._exchange:
            beats, self._beats = self._beats, defaultdict(list)
        return beats

    def until(self, robots):
        """Wait until each of them is heard."""
        heard = set()

        def all_heard():
            heard.update(self.take())
            return set(robots) <= heard

        eventually(all_heard, START_S, lambda: f"heartbeats of {sorted(set(robots) - heard)}")


class Fleet:
    """Robots of a scene under a router; a context manager.

    Args:
        folder: where they run.
        scene: that each of them stands in.

    Attributes:
        scene: that each of them stands in.
        endpoints: of the routers; each joins the one before.
    """

    def __init__(self, folder, scene):
        self._folder = folder
        self.scene = scene
        self._stack = contextlib.ExitStack()
        self.endpoints, self._routers, self._robots = [], [], {}

    def __enter__(self):
        self.join()
        self.beats = self._stack.enter_context(Beats(self.endpoints[0]))
        return self

    def __exit__(self, *_):
        self._stack.close()

    @property
    def names(self):
        """Of the robots."""
        return tuple(self._robots)

    def join(self):
        """One more router, which joins the one before."""
        endpoint = free_endpoint()
        upstream = ("--connect", self.endpoints[-1]) if self.endpoints else ()
        router = self._stack.enter_context(Command("router", "--listen", endpoint, *upstream, folder=self._folder))
        router.until(lambda: reachable(endpoint), START_S, "the router listens")
        self.endpoints.append(endpoint)
        self._routers.append(router)

    def grow(self, count):
        """Start robots until there are so many."""
        added = [f"{self.scene}{number}" for number in range(len(self._robots), count)]
        for name in added:
            self._robots[name] = self.start(name)
        self.beats.until(added)

    def start(self, name):
        """One robot's process."""
        where = ("--connect", self.endpoints[0])
        return self._stack.enter_context(
            Command("robot", "--robot", name, "--scene", self.scene, *where, folder=self._folder)
        )

    def shrink(self, count):
        """Stop robots until there are so many."""
        for name in self.names[count:]:
            self._robots.pop(name).stop()

    @contextlib.contextmanager
    def operated(self):
        """All robots move, each led by its operator at the last router; how to ask for the traffic.

        Raises:
            Stuck: not all of them move in time.
        """
        program = [sys.executable, "-I", Path(__file__).with_name("operators.py"), self.endpoints[-1], *self.names]
        log = self._folder / "operators.err"
        with log.open("w") as told:
            process = subprocess.Popen(program, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=told, text=True)
        timer = threading.Timer(START_S, process.kill)
        timer.start()
        try:
            if process.stdout.readline() != "executing\n":
                raise Stuck((log.read_text().splitlines() or ["nobody says why"])[-1])
            timer.cancel()
            yield lambda: _told(process)
        finally:
            timer.cancel()
            process.kill()
            process.wait()
            process.stdin.close()
            process.stdout.close()

    def cost(self, traffic, seconds):
        """What the robots take in so long an interval, while they are operated."""
        time.sleep(SETTLE_S)
        routers = [psutil.Process(router.process.pid) for router in self._routers]
        before, used = traffic(), sum(_cpu_s(router) for router in routers)
        self.beats.take()
        began = time.monotonic()
        time.sleep(seconds)
        took = time.monotonic() - began
        beats, used = self.beats.take(), sum(_cpu_s(router) for router in routers) - used
        after = traffic()
        memory = [psutil.Process(robot.process.pid).memory_full_info().pss for robot in self._robots.values()]
        heard = [beats[name] for name in self.names]
        return Cost(
            robots=len(heard),
            routers=len(routers),
            **regularity([beat for robot in heard for beat in robot]),
            late=late_share(heard),
            processor=float(np.mean([_share(robot) for robot in heard])),
            memory_mb=float(np.mean(memory)) / 1e6,
            routing=used / took,
            traffic=rates(before, after, took),
        )


def rates(before, after, took):
    """Messages and bytes a second, by topic, of two counts."""
    rest = {name: np.subtract(count, before.get(name, (0, 0))) / took for name, count in after.items()}
    return {name: tuple(rate.tolist()) for name, rate in rest.items() if rate[0] > 0.0}


def regularity(beats):
    """Period and latency over heartbeats [ms]."""
    figures = [{figure.name: figure.value for figure in beat.figures} for beat in beats]
    return {
        "period_p50_ms": 1e3 * _median([beat.period_p50 for beat in beats]),
        "period_p99_ms": 1e3 * _median([beat.period_p99 for beat in beats]),
        # Zero where no sample acted for the first time in the interval: the robot held.
        "latency_p50_ms": _median([value for each in figures if (value := each["sample_to_command_p50"])]),
        "latency_p99_ms": _median([value for each in figures if (value := each["sample_to_command_p99"])]),
    }


def late_share(robots):
    """Share of the ticks that were late, of robots' heartbeats."""
    late = sum(beats[-1].late_ticks - beats[0].late_ticks for beats in robots if beats)
    return late / max(1, sum(beats[-1].ticks - beats[0].ticks for beats in robots if beats))


def _median(values):
    return float(np.median(values)) if values else float("nan")


def _share(beats):
    """Of a core, by the first and the last heartbeat."""
    if len(beats) < 2:
        return float("nan")
    return (beats[-1].cpu_s - beats[0].cpu_s) / ((beats[-1].stamp_ns - beats[0].stamp_ns) / 1e9)


def _cpu_s(process):
    times = process.cpu_times()
    return times.user + times.system


def _told(process):
    process.stdin.write("\n")
    process.stdin.flush()
    return json.loads(process.stdout.readline())
