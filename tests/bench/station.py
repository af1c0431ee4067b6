"""The operator's page in a real browser: what it loads, how often it draws, how soon a key moves the robot.

Runs `retouch up` as a person would, opens the page in Chromium, lets two people look on from elsewhere, and taps a key
all through a refinement. Then a scripted person teaches an empty skill by waypoints, and their time
is taken. Without a graphics card the 3-D view is drawn by the processor, beside all else.
"""

import argparse
import contextlib
import secrets
import shutil
import sys
import tempfile
import threading
import time
from pathlib import Path

import msgspec
import numpy as np
import psutil
from playwright.sync_api import TimeoutError as NotThere
from playwright.sync_api import sync_playwright
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from protocol import topics
from protocol.codec import decode
from protocol.messages import Mode, Phase
from services.bus.stages import stages
from services.bus.zenoh import open_session, watch
from services.process.config import load
from services.station.page.link import FRAME_HEADER
from services.station.page.said import Held, Hello
from tests.bench.support.path import OwnPath
from tests.bench.support.results import Result, report
from tests.bench.support.teaching import SCENE as TAUGHT
from tests.bench.support.teaching import teach
from tests.conftest import CHROMIUM_FLAGS
from tests.system.harness import START_S, Command, Witness, configured, free_endpoint

SIZE = {"width": 1600, "height": 900}
REFINE_S = 60.0
EPISODE_S = 120.0
HEARD_S = 2.0
TAP_MS, BETWEEN_MS = 120, 380
GROWN_M = 1e-4
"""The displacement of a hand at the key: no more than it grows in one period of the master."""

GOALS = {"station": 10.0, "viewer": 15.0}
"""Processor, of a core [%]."""

KEY, AXIS = "e", 2
"""Up."""

COUNT = """
    window.drawn = 0;
    const fence = WebGL2RenderingContext.prototype.fenceSync;
    WebGL2RenderingContext.prototype.fenceSync = function (...rest) {
        window.drawn += 1;
        return fence.apply(this, rest);
    };
"""
"""How many pictures were drawn."""

DRAWN = """
    window.foresights = [], window.ages = [];
    const aging = new MutationObserver((changes) => {
        for (const { target } of changes) window.ages.push(Number(target.dataset.ageMs));
    });
    const ages = { attributeFilter: ["data-age-ms"] };
    for (const canvas of document.querySelectorAll(".picture")) aging.observe(canvas, ages);
    const watcher = new MutationObserver((changes) => {
        for (const { target } of changes) window.foresights.push(Number(target.dataset.foresightMs));
    });
    watcher.observe(document.querySelector(".scene"), { attributeFilter: ["data-foresight-ms"] });
"""
"""How long it took each time to foresee how the motion goes on, and since when what each picture shows was [ms]."""


class Operator:
    """A person at the page.

    Args:
        browser: where to open it.
        url: of the page.
    """

    def __init__(self, browser, url):
        self.page = browser.new_page(viewport=SIZE)
        self.page.add_init_script(f"localStorage.setItem('retouch-tour', 'seen'); {COUNT}")
        self.loaded, self.taps_ns = 0, []
        network = self.page.context.new_cdp_session(self.page)
        network.send("Network.enable")
        network.on("Network.loadingFinished", self._count)
        began = time.monotonic()
        self.page.goto(url)
        self.page.wait_for_selector("body[data-link=armed]", timeout=START_S * 1e3)
        self.page.wait_for_selector(".scene[data-view=live]", timeout=START_S * 1e3)
        self.usable_s = time.monotonic() - began

    def _count(self, finished):
        self.loaded += finished["encodedDataLength"]

    def press(self, action, seen):
        """Press a button once it is offered, and again where the press came too late to be done, until `seen()`."""
        deadline = time.monotonic() + EPISODE_S
        while not seen():
            if time.monotonic() > deadline:
                raise SystemExit(f"bench: {action} does not count")
            with contextlib.suppress(NotThere):
                self.page.locator(f"[data-action={action}]:enabled").click(timeout=HEARD_S * 1e3)
            self.page.wait_for_timeout(HEARD_S * 1e3)

    def tap(self):
        """Press a key for a moment."""
        self.taps_ns.append(time.monotonic_ns())
        self.page.keyboard.down(KEY)
        self.page.wait_for_timeout(TAP_MS)
        self.page.keyboard.up(KEY)
        self.page.wait_for_timeout(BETWEEN_MS)


class Onlooker(threading.Thread):
    """Somebody at another computer who looks on: gets all that a browser there would draw at once.

    Args:
        url: of the page.
    """

    def __init__(self, url):
        super().__init__(daemon=True)
        self._url = url
        self.over = threading.Event()

    def run(self):
        with contextlib.suppress(ConnectionClosed):  # the station may end first
            self._look_on()

    def _look_on(self):
        with connect(f"{self._url.replace('http', 'ws')}link", origin=self._url.rstrip("/"), max_size=None) as link:
            name = secrets.token_hex(8)
            link.send(msgspec.json.encode(Hello(name, name)).decode())
            drawn, said = [0, 0, 0, 0], 0
            while not self.over.is_set():
                frame = link.recv()
                if isinstance(frame, str):
                    continue
                kind, _, number, _ = FRAME_HEADER.unpack_from(frame)
                drawn[kind], said = number, said + 1
                held = Held(said, time.monotonic() * 1e3, (), True, False, (), tuple(drawn))
                link.send(msgspec.json.encode(held).decode())


@contextlib.contextmanager
def operated(*flags, refine_s=20.0):
    """A whole system with somebody at its page: the operator, a witness, where the page is and its network."""
    with tempfile.TemporaryDirectory() as name, sync_playwright() as started:
        folder, endpoint = Path(name), free_endpoint()
        configuration = configured(folder, endpoint, station=f"refine_s = {refine_s}\n")
        section = load(configuration).station
        up = ("up", "--fresh", "--no-browser", *flags, "--config", configuration)
        browser = started.chromium.launch(executable_path=shutil.which("chromium"), args=list(CHROMIUM_FLAGS))
        with Command(*up, folder=folder) as command, Witness(endpoint) as witness:
            command.until(lambda: witness.teaching, START_S, "the station is there")
            url = f"http://{section.host}:{section.port}/"
            yield Operator(browser, url), witness, url, endpoint
        browser.close()


def run(scene):
    """One run; its figures."""
    with operated("--scene", scene, refine_s=REFINE_S) as (operator, witness, url, endpoint):
        onlookers = [Onlooker(url) for _ in range(2)]
        for onlooker in onlookers:
            onlooker.start()
        figures = refine(operator, witness, endpoint)
        for onlooker in onlookers:
            onlooker.over.set()
    with operated("--scene", TAUGHT, "--untaught") as (teacher, witness, _, _):
        taught = teach(teacher.page, witness)
    return [
        Result("page until it can be used", operator.usable_s, "s", 2.0),
        Result("page, all that is loaded", operator.loaded / 1e6, "MB", 3.0),
        *figures,
        *taught,
    ]


def refine(operator, witness, endpoint):
    """Tap all through a refinement; how soon each tap moved the robot, and what all of it cost."""
    operator.press("execute", lambda: witness.robot is not None and witness.robot.episode > 0)
    operator.press("refine", lambda: is_corrected(witness.robot))
    with states(endpoint) as heard:
        operator.page.evaluate(DRAWN)
        drawn, began = operator.page.evaluate("window.drawn"), time.monotonic()
        before = costs(witness)
        while time.monotonic() - began < REFINE_S / 2:
            operator.tap()
        took = time.monotonic() - began
        after = costs(witness)
    latencies = np.array(latencies_ms(operator.taps_ns, *heard.values()))
    said, displaced, applied = np.percentile(latencies, 50, axis=0)
    pictures = operator.page.evaluate("window.drawn") - drawn
    foresights, ages = (np.array(operator.page.evaluate(f"window.{name}")) for name in ("foresights", "ages"))
    path = OwnPath()
    for input_ in heard[topics.OPERATOR_INPUT]:
        path.keep(stages(operator=input_))
    for master in heard[topics.MASTER_STATE]:
        path.keep(stages(master=master))
    for robot in heard[topics.ROBOT_STATE]:
        path.keep(stages(robot=robot))
    held = np.mean([robot.phase is Phase.HOLD for robot in heard[topics.ROBOT_STATE]])
    return [
        Result("key to displacement applied, p50", float(applied), "ms", 15.0),
        Result("of it, until the station says the key", float(said), "ms"),
        Result("of it, until the master is displaced", float(displaced), "ms"),
        Result("key to displacement applied, p99", float(np.percentile(latencies[:, 2], 99)), "ms", 50.0),
        *path.results(),
        Result("taps that moved the robot", len(latencies), "1"),
        Result("robot holds though somebody is at the keys", 100.0 * float(held), "%"),
        Result("3-D view, pictures a second", pictures / took, "Hz"),
        Result("picture's age on the canvas, p50", float(np.percentile(ages, 50)), "ms", 60.0),
        Result("picture's age on the canvas, p99", float(np.percentile(ages, 99)), "ms"),
        Result("pictures on the canvases", len(ages) / took, "Hz"),
        Result("foresight reckoned, p50", float(np.percentile(foresights, 50)), "ms"),
        Result("foresight reckoned, p99", float(np.percentile(foresights, 99)), "ms", 20.0),
        Result("foresight, times a second", len(foresights) / took, "Hz"),
        *(
            Result(f"{name}: processor", 100.0 * (after[name] - before[name]) / took, "% of a core", GOALS.get(name))
            for name in before
        ),
    ]


def is_corrected(robot):
    """Whether it moves, and somebody may correct it."""
    return robot is not None and robot.mode is Mode.REFINE and robot.phase is Phase.EXECUTE


@contextlib.contextmanager
def states(endpoint):
    """What station, master and robot say meanwhile, by topic."""
    passed, heard = [], {topics.OPERATOR_INPUT: [], topics.MASTER_STATE: [], topics.ROBOT_STATE: []}
    session = open_session(endpoint, START_S)
    try:
        for topic in heard:
            watch(session, topic.key("robot1", "*"), lambda passing, topic=topic: passed.append((topic, passing)))
        yield heard
    finally:
        session.close()
    for topic, passing in passed:
        heard[topic].append(decode(topic, passing.payload, passing.schema))


def costs(witness):
    """Processor time so far of who has to do with the page [s]."""
    beats = witness.next_beats({"station", "viewer", "robot", "camera"}, 30.0)
    browser = [each.cpu_times() for each in psutil.Process().children(recursive=True) if "chrom" in each.name()]
    told = {name: beats[name].cpu_s for name in ("station", "viewer", "camera", "robot")}
    return {**told, "browser": sum(each.user + each.system for each in browser)}


def latencies_ms(taps_ns, inputs, masters, robots):
    """From each key press until the station says it, until it has displaced the master, and until the arm was told what
    that displacement had shaped [ms], a row each."""
    said_ns = np.array([said.stamp_ns for said in inputs if f"Key{KEY.upper()}" in said.keys])
    moved = np.array([master.displacement[AXIS] for master in masters])
    masters_ns, robots_ns = (np.array([state.stamp_ns for state in states]) for states in (masters, robots))
    applied = np.array([robot.applied_sequence for robot in robots])
    latencies = []
    for tap_ns in taps_ns:
        first = int(np.searchsorted(masters_ns, tap_ns))
        grown = np.flatnonzero(moved[first:] > moved[max(first - 1, 0)] + GROWN_M)
        if not grown.size:
            continue
        told = np.flatnonzero(applied >= masters[first + grown[0]].sequence)
        if not told.size or robots_ns[told[0]] - tap_ns >= (TAP_MS + BETWEEN_MS) * 1e6:
            continue
        stages_ns = said_ns[np.searchsorted(said_ns, tap_ns)], masters_ns[first + grown[0]], robots_ns[told[0]]
        latencies.append([(stage_ns - tap_ns) / 1e6 for stage_ns in stages_ns])
    return latencies


def main():
    parser = argparse.ArgumentParser(prog="deploy/bench station", description=__doc__)
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON")
    parser.add_argument("--scene", default="dishwasher", help="where the robot stands (default: dishwasher)")
    arguments = parser.parse_args()
    print("bench: one refinement and one skill taught at the page, about four minutes", file=sys.stderr)
    report(run(arguments.scene), arguments.json)


if __name__ == "__main__":
    main()
