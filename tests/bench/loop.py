"""The whole loop on this machine, cameras and viewer on: latency, regularity, pictures, processor, memory, start.

Runs `retouch up --headless` as a person would and listens on the bus beside it. One run, every figure from it.
"""

import argparse
import contextlib
import json
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import psutil

from protocol import topics
from protocol.codec import decode
from protocol.exceptions import ProtocolError
from protocol.messages import Mode, Phase
from services.bus.stages import stages
from services.bus.zenoh import Passing, open_session, watch
from services.process.clock import SystemClock
from services.process.isolation import retouch_command
from sim.tasks import SCENES
from tests.bench.support.path import OwnPath
from tests.bench.support.results import Result, report
from tests.cameras import HEAD_IMAGE, WRIST_IMAGE

RUN_TIMEOUT_S = 300.0
MEMORY_EVERY_S = 5.0


class Ear:
    """Everything that passes, as it is needed for the figures."""

    def __init__(self):
        self.clock = SystemClock()
        self.robot_stamps = []
        self.latencies = {}
        self.path = OwnPath()
        self.pictures = {"head": [], "wrist": []}
        self.beats = {}
        self.haptic_p99 = []
        self.first_motion_ns = None
        self.refining = False

    def hear(self, passing: Passing):
        name = "/".join(passing.key.split("/")[3:-1])
        handler = {
            topics.ROBOT_STATE.name: (topics.ROBOT_STATE, self._robot),
            HEAD_IMAGE.name: (HEAD_IMAGE, self._picture),
            WRIST_IMAGE.name: (WRIST_IMAGE, self._picture),
            topics.HEARTBEAT.name: (topics.HEARTBEAT, self._beat),
        }.get(name)
        if handler is None:
            return
        topic, use = handler
        try:
            use(decode(topic, passing.payload, passing.schema))
        except ProtocolError as error:
            print(f"bench: {error}", file=sys.stderr)

    def _robot(self, state):
        if self.first_motion_ns is None and state.phase in (Phase.RAMP, Phase.EXECUTE):
            self.first_motion_ns = self.clock.now_ns()
        self.refining = state.mode is Mode.REFINE and state.phase is Phase.EXECUTE
        self.robot_stamps.append(state.stamp_ns)
        if self.refining and state.applied_latency >= 0.0:
            if state.applied_sequence not in self.latencies:
                self.path.keep(stages(robot=state))
            self.latencies[state.applied_sequence] = state.applied_latency

    def _picture(self, image):
        now = self.clock.now_ns()
        self.pictures[image.camera].append((now, (now - image.captured_ns) / 1e9))

    def _beat(self, beat):
        self.beats.setdefault(beat.process, []).append((self.clock.now_ns(), beat))
        if beat.process == "master" and self.refining:
            self.haptic_p99 += [f.value for f in beat.figures if f.name == "haptic_period_p99"]


def free_endpoint():
    with socket.create_server(("127.0.0.1", 0)) as server:
        return f"tcp/127.0.0.1:{server.getsockname()[1]}"


def memory_of(pids):
    """Proportional set size of the processes together [byte]: shared pages count once."""
    total = 0
    for pid in pids:
        try:
            total += psutil.Process(pid).memory_full_info().pss
        except psutil.Error:
            continue
    return total


def children_of(pid):
    try:
        return [pid, *(child.pid for child in psutil.Process(pid).children(recursive=True))]
    except psutil.Error:
        return []


def run(scene, robot_model):
    """One run: what was heard, the report, the memory samples [byte] and when the command began [ns]."""
    ear, memory = Ear(), []
    endpoint = free_endpoint()
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        command = retouch_command(("up", "--fresh", "--headless", "--once", "--json", str(report)))
        command += ["--scene", scene, "--listen", endpoint]
        if robot_model is not None:
            command += ["--robot-model", robot_model]
        with (Path(folder) / "log.txt").open("w") as log:
            began_ns = ear.clock.now_ns()
            process = subprocess.Popen(command, cwd=folder, stdout=log, stderr=subprocess.STDOUT)
            session = open_session(endpoint, timeout_s=30.0)
            try:
                watch(session, "retouch/@v1/*/**", ear.hear)
                deadline = time.monotonic() + RUN_TIMEOUT_S
                while process.poll() is None and time.monotonic() < deadline:
                    memory.append(memory_of(children_of(process.pid)))
                    with contextlib.suppress(subprocess.TimeoutExpired):
                        process.wait(MEMORY_EVERY_S)
            finally:
                session.close()
                process.terminate()
                process.wait(10.0)
        if not report.exists():
            sys.exit("bench: the run ended without a report:\n" + (Path(folder) / "log.txt").read_text()[-2000:])
        return ear, json.loads(report.read_text()), memory, began_ns


def figures(ear, report, memory, began_ns):
    latencies = np.array(list(ear.latencies.values())) * 1e3
    periods = np.diff(np.array(ear.robot_stamps)) / 1e6
    robot = ear.beats["robot"][-1][1]
    results = [
        # Until everything is ready, and what the scripted operator's press and the reset after it take besides.
        Result("time from the command to the first motion", _since(began_ns, ear.first_motion_ns), "s", 5.0),
        Result("device's sample to the command it shapes, handed over, p50", _percentile(latencies, 50), "ms", 5.0),
        Result("device's sample to the command it shapes, handed over, p99", _percentile(latencies, 99), "ms", 15.0),
        Result("control period, p50", _percentile(periods, 50), "ms"),
        Result("control period, p99", _percentile(periods, 99), "ms"),
        Result("late control ticks", 100.0 * robot.late_ticks / robot.ticks, "%", 0.5),
        Result("haptic period p99, median of intervals", float(np.median(ear.haptic_p99)), "ms", 2.0),
        Result("haptic period p99, worst interval", float(np.max(ear.haptic_p99)), "ms"),
        Result("simulation behind the clock", _figure(robot, "simulation_lag"), "s"),
    ]
    results += ear.path.results()  # nobody is at a page here: the first stage and the last are `deploy/bench station`'s
    for camera, pictures in ear.pictures.items():
        stamps, ages = np.array(pictures).T
        seconds_a_picture = float(np.median(np.diff(stamps))) / 1e9
        results.append(
            Result(f"{camera} camera, time between pictures", 1e3 * seconds_a_picture, "ms", 1e3 / 15 * 1.02)
        )
        results.append(Result(f"{camera} camera, age p50", 1e3 * float(np.median(ages)), "ms", 100.0))
        results.append(Result(f"{camera} camera, age p99", 1e3 * _percentile(ages, 99), "ms"))
    total = 0.0
    for name, beats in sorted(ear.beats.items()):
        (t0, a), (t1, b) = beats[0], beats[-1]
        share = 100.0 * (b.cpu_s - a.cpu_s) / ((t1 - t0) / 1e9)
        total += share
        results.append(Result(f"{name}: processor", share, "% of a core"))
        results.append(Result(f"{name}: memory, largest", b.memory / 1e6, "MB"))
    results.append(Result("all processes: processor", total, "% of a core", 200.0))
    results.append(Result("all processes: memory (shared pages once), largest", max(memory) / 1e6, "MB", 1500.0))
    results.append(Result("loop closed", 1.0 - report["loop_closed"], "0 = yes", 0.0))
    return results


def _since(began_ns, then_ns):
    return (then_ns - began_ns) / 1e9 if then_ns is not None else float("inf")


def _percentile(samples, q):
    return float(np.percentile(samples, q))


def _figure(beat, name):
    return next((f.value for f in beat.figures if f.name == name), float("nan"))


def main():
    parser = argparse.ArgumentParser(prog="deploy/bench loop", description=__doc__)
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON")
    parser.add_argument("--robot-model", metavar="NAME|FILE", help="the robot in it (default: tiago)")
    parser.add_argument("--scene", default="dishwasher", help=f"{', '.join(SCENES)} (default: dishwasher)")
    arguments = parser.parse_args()
    print("bench: one run of the whole loop, about 80 s", file=sys.stderr)
    report(figures(*run(arguments.scene, arguments.robot_model)), arguments.json)


if __name__ == "__main__":
    main()
