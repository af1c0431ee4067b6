"""One message from a process to another: the bus beside raw Zenoh, sockets, pyzmq, Cyclone DDS and MQTT.

Each of them carries a master's state of some 450 bytes, at 100 Hz and 1 kHz, with and without two cameras beside it,
in the clear and over TLS with certificates on both sides. One way, by the machine's one clock, from before a message is
sent until it can be used: on the bus from `publish` until it is decoded, judged and stored; on raw Zenoh, with which it
is compared, from before it is stamped and encoded until it is decoded, for no program could use less. The others, and
Zenoh's bare bytes, are floors: what they carry is encoded before and never decoded. Over TLS the bus' router has access
rules and quotas, which raw Zenoh's has not; a person's commands may come a thousand times a second at most, in turn and
not two at once, so the quotas are widened here: what they would turn away at 1 kHz is no delay and no loss of the bus.
All take turns in each round, so that what slows the
machine down slows all of them down. The figures are medians over the rounds; ratios are taken within each round.
"""

import argparse
import contextlib
import itertools
import os
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from services.certificates.authority import make_authority
from services.process.runner import leave_on_signals
from tests.bench.support.results import Result, write_json
from tests.bench.wire.peers import Absent
from tests.bench.wire.way import CARRIERS, Broken, Way, payload

RATES_HZ = (100.0, 1000.0)
GOAL = 1.3
"""Times raw Zenoh's."""

NAMES = ("router.kitchen", "operator.anna", "operator.bob", "camera.kitchen")


@dataclass(frozen=True)
class Case:
    """What is sent."""

    rate_hz: float
    pictures: bool

    @property
    def about(self):
        """In words."""
        return f"{self.rate_hz:g} Hz{', cameras beside' if self.pictures else ''}"


CASES = tuple(Case(*shape) for shape in itertools.product(RATES_HZ, (False, True)))


@dataclass(frozen=True)
class Carried(Result):
    """One way in one case: `value` is the median [us]; the ratios are to raw Zenoh's with the same encryption."""

    case: str = ""
    p99: float = float("nan")
    lost: float = 0.0
    ratio: float = float("nan")
    ratio_p99: float = float("nan")
    rounds: int = 0


def carried(case, way, bursts, references):
    """The figures of a way: its bursts in the rounds beside raw Zenoh's in the same ones."""
    p50, p99 = _quantiles(bursts)
    ratio, ratio_p99 = (np.median(own / raw) for own, raw in zip((p50, p99), _quantiles(references), strict=True))
    return Carried(
        name=way.about,
        value=float(np.median(p50)),
        unit="us",
        case=case.about,
        p99=float(np.median(p99)),
        lost=float(np.mean([burst.lost for burst in bursts])),
        ratio=float(ratio),
        ratio_p99=float(ratio_p99),
        rounds=len(bursts),
    )


def _quantiles(bursts):
    """Medians and 99th percentiles of the bursts, shape (n,) each; not a number where nothing came."""
    return np.array(
        [np.percentile(b.latencies_us, (50, 99)) if len(b.latencies_us) else (np.nan, np.nan) for b in bursts]
    ).T


def goals(results):
    """What the bus is to reach, of each case."""
    for one in results:
        if one.name.startswith("the bus"):
            tls = one.name.removeprefix("the bus")
            yield Result(f"{one.case}{tls}: median, times raw Zenoh's", one.ratio, "", GOAL)
            yield Result(f"{one.case}{tls}: p99, times raw Zenoh's", one.ratio_p99, "", GOAL)


def measure(ways, rounds, seconds):
    """All bursts, by case and way."""
    bursts = {(case, way): [] for case in CASES for way in ways}
    for turn in range(rounds):
        for case in CASES:
            print(f"bench: round {turn + 1} of {rounds}, {case.about}", file=sys.stderr)
            for way in ways:
                bursts[case, way].append(way.burst(case.rate_hz, seconds, case.pictures))
    return bursts


def opened(stack, folder):
    """All the ways that can be had; says which cannot."""
    authority = make_authority(folder / "certs")
    for name in NAMES:
        authority.issue(name)
    for carrier in CARRIERS:
        for certificates in (None, authority.folder) if carrier.secure else (None,):
            try:
                yield stack.enter_context(Way(carrier, certificates))
            except (Absent, Broken) as reason:
                print(f"bench: {reason}", file=sys.stderr)


def table(results):
    """The lines to print, a block a case."""
    for case in dict.fromkeys(one.case for one in results):
        yield f"\n{case:<28}{'p50 us':>9}{'p99 us':>9}{'lost %':>8}{'p50 ratio':>11}{'p99 ratio':>11}"
        for one in results:
            if one.case == case:
                yield (
                    f"  {one.name:<26}{one.value:9.0f}{one.p99:9.0f}{100.0 * one.lost:8.2f}{one.ratio:11.2f}"
                    f"{one.ratio_p99:11.2f}"
                )


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="deploy/bench transport", description=__doc__)
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON")
    parser.add_argument("--quick", action="store_true", help="one short round: does it work at all?")
    parser.add_argument("--rounds", type=int, default=5, metavar="N", help="in which all take turns (default: 5)")
    options = parser.parse_args(arguments)
    leave_on_signals()  # whatever was started goes, too
    if options.json is not None and not options.json.parent.is_dir():
        parser.error(f"--json: the folder {options.json.parent} does not exist")
    if options.rounds < 1:
        parser.error("--rounds: give at least 1")
    rounds, seconds = (1, 0.5) if options.quick else (options.rounds, 2.5)
    before = os.getloadavg()[0]
    with contextlib.ExitStack() as stack:
        ways = list(opened(stack, Path(stack.enter_context(tempfile.TemporaryDirectory()))))
        seconds_all = rounds * len(CASES) * len(ways) * (seconds + 0.9)
        print(f"bench: {len(ways)} ways, about {seconds_all / 60.0:.0f} min", file=sys.stderr)
        bursts = measure(ways, rounds, seconds)
    results = []
    for (case, way), own in bursts.items():
        reference = next((raw for raw in ways if raw.secure == way.secure and raw.carrier is CARRIERS[0]), way)
        results.append(carried(case, way, own, bursts[case, reference]))
    for line in table(results):
        print(line)
    told = [*goals(results), Result("payload", float(len(payload())), "byte")]
    told.append(Result("load average before", before, ""))
    told.append(Result("load average after, this benchmark's own included", os.getloadavg()[0], ""))
    print()
    for one in told:
        print(f"{one.name:<52} {one.value:8.2f} {one.unit}   {one.verdict}".rstrip())
    if options.json is not None:
        write_json(options.json, [*results, *told])


if __name__ == "__main__":
    main()
