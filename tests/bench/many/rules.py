"""What access rules cost a router, for networks of one, ten and a hundred sites: generated, opened, and per message."""

import contextlib
import json
import sys
import tempfile
import threading
import time
from datetime import timedelta
from pathlib import Path

import psutil

from protocol import topics
from protocol.messages import Phase, Pose, RobotState
from protocol.rights import SITE, subject
from services.bus.zenoh import connect
from services.bus.zenoh.access import access_control, quotas
from services.certificates import register
from services.certificates.authority import DAYS, make_authority
from services.certificates.credentials import Credentials
from services.certificates.register import Issued, Register
from services.process.clock import SystemClock
from tests.bench.support.results import Result
from tests.ports import free_port
from tests.system.harness import START_S, Command, reachable

SITES = (1, 10, 100)
ROBOTS_A_SITE, PEOPLE_A_SITE = 10, 3
"""A thousand robots at a hundred sites with three hundred operators."""

MESSAGE_HZ, MESSAGES_S = 500.0, 3.0
NOWHERE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
OWN = ("router.site0", "robot.robot0", "operator.person0")
"""Whose certificates are made; of the others only the names are in the register."""


def names(sites):
    """Of all certificates of a network."""
    yield from (f"router.site{n}" for n in range(sites))
    processes = [kind for kind in SITE if kind != "router"]
    yield from (f"{kind}.robot{n}" for n in range(sites * ROBOTS_A_SITE) for kind in processes)
    yield from (f"operator.person{n}" for n in range(sites * PEOPLE_A_SITE))


def generated(sites):
    """The sections of a router's settings that follow from the certificates."""
    subjects = [(name, subject(name)) for name in names(sites)]
    return {"access_control": access_control(subjects), **quotas(subjects)}


def measure(chosen=SITES):
    """The figures, for each number of sites."""
    for sites in chosen:
        print(f"bench: access rules of {sites} sites", file=sys.stderr)
        began = time.perf_counter()
        made = generated(sites)
        took = time.perf_counter() - began
        where = f"{sites} sites"
        yield Result(f"{where}: certificates", float(len(made["access_control"]["subjects"])), "")
        yield Result(f"{where}: renewed a day, at {DAYS} days' life", len(list(names(sites))) / DAYS, "")
        yield Result(f"{where}: access rules", float(len(made["access_control"]["rules"])), "")
        yield Result(f"{where}: rate limits", float(sum(len(one["rules"]) for one in made["downsampling"])), "")
        yield Result(f"{where}: settings of a router", len(json.dumps(made)) / 1e6, "MB")
        yield Result(f"{where}: generating them", took, "s")
        yield from _opened(where, sites)


def _opened(where, sites):
    """A real router with them."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        certificates = _registered(folder, sites)
        port = free_port()
        endpoint = f"tls/127.0.0.1:{port}"
        arguments = ("router", "--tls", certificates, "--listen", endpoint)
        began = time.monotonic()
        with Command(*arguments, folder=folder) as router:
            router.until(lambda: reachable(f"tcp/127.0.0.1:{port}"), START_S, "the router listens")
            yield Result(f"{where}: a router starts", time.monotonic() - began, "s")
            process = psutil.Process(router.process.pid)
            yield Result(f"{where}: router's memory", process.memory_full_info().pss / 1e6, "MB")
            cpu_us, came = _routed(endpoint, certificates, process)
            yield Result(f"{where}: router's processor, a message of a robot to one operator", cpu_us, "us")
            yield Result(f"{where}: of such messages came", 100.0 * came, "%")


def _registered(folder, sites):
    """An authority's folder whose register names everybody."""
    certificates = folder / "certs"
    authority = make_authority(certificates)
    for name in OWN:
        authority.issue(name)
    until = register.now() + timedelta(days=DAYS)
    others = tuple(Issued(name, 0, "0", until) for name in names(sites) if name not in OWN)
    register.save(Register((*authority.register.issued, *others)), certificates)
    return certificates


def _routed(endpoint, certificates, router):
    """Processor time of the router a message [us], and the share that came."""
    clock = SystemClock()
    with contextlib.ExitStack() as stack:

        def joined(name, process):
            bus = connect(
                endpoint,
                "robot0",
                process,
                clock,
                timeout_s=START_S,
                credentials=Credentials(certificates, subject(name)),
            )
            stack.callback(bus.close)
            return bus

        heard = Heard()
        joined(OWN[2], "viewer-person0").subscribe(topics.ROBOT_STATE, heard)
        robot = joined(OWN[1], "robot")
        state = RobotState(measured=NOWHERE, reference=NOWHERE, phase=Phase.IDLE)
        deadline = time.monotonic() + START_S
        while not heard.count and time.monotonic() < deadline:
            robot.publish(topics.ROBOT_STATE, state)
            time.sleep(1.0 / MESSAGE_HZ)
        before, heard.count, sent = router.cpu_times(), 0, 0
        end = time.monotonic() + MESSAGES_S
        while time.monotonic() < end:
            robot.publish(topics.ROBOT_STATE, state)
            sent += 1
            time.sleep(1.0 / MESSAGE_HZ)
        after = router.cpu_times()
    used = after.user + after.system - before.user - before.system
    return 1e6 * used / sent, min(1.0, heard.count / sent)


class Heard(threading.Event):
    """Counts what is there to be read."""

    def __init__(self):
        super().__init__()
        self.count = 0

    def set(self):
        self.count += 1
