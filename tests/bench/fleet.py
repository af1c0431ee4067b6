"""Many robots: how what they cost grows, presence, and whether fifty observers touch a robot's control.

Robots are real processes, particles and arms, each led through refinements by an operator; one process stands in for
the desks of all operators and reads everything that is said of their robots. 1, 4 and 16 of them are under one router,
and under one while their operators are at another one that joins it. What this machine cannot bear is told and left
out. Also: what the access rules of 1, 10 and 100 sites cost a router. deploy/scale.md reckons with these figures.
"""

import argparse
import os
import sys
import tempfile
from pathlib import Path

from services.process.runner import leave_on_signals
from tests.bench.many import looking, presence, rules
from tests.bench.many.fleet import Fleet, Stuck
from tests.bench.support.results import Result, write_json
from tests.cameras import TOPICS

SCENES = {"particle": "particle", "table": "arm"}
"""What stands in it, by scene."""

COUNTS = (1, 4, 16)
SHARE = 0.9
"""Of the machine's cores that robots may take; routers and operators need some, too."""

LATE_GOAL = 0.5
"""[%] of the ticks, as for a whole loop (`deploy/bench loop`)."""


def bearable(counts, processor, cores):
    """Which numbers of robots a machine bears, by what one of them takes [cores]."""
    return tuple(count for count in counts if count * processor <= SHARE * cores)


def growth(scene, counts, seconds):
    """What robots cost, for each number of them and of routers: those that the machine bears."""
    with tempfile.TemporaryDirectory() as name, Fleet(Path(name), scene) as fleet:
        processor, cores = 0.0, os.cpu_count() or 1
        for count in counts:
            if not bearable((count,), processor, cores):
                need = f"{count * processor:.1f} of {cores} cores"
                print(f"bench: {count} of {scene} left out: they need {need}", file=sys.stderr)
                break
            fleet.grow(count)
            for cost in _cost(fleet, seconds):
                processor = cost.processor
                yield cost
        fleet.join()
        for count in reversed(counts):
            if count <= len(fleet.names):
                fleet.shrink(count)
                yield from _cost(fleet, seconds)


def _cost(fleet, seconds):
    """What the robots cost; nothing, and a line, where this machine cannot move them all."""
    what = f"{len(fleet.names)} of {fleet.scene} under {len(fleet.endpoints)}"
    print(f"bench: {what}", file=sys.stderr)
    try:
        with fleet.operated() as traffic:
            yield fleet.cost(traffic, seconds)
    except Stuck as reason:
        print(f"bench: {what} left out: not all of them move here: {reason}", file=sys.stderr)


def passed(cost):
    """Messages a second that the first router took in: what robots and operators say."""
    return sum(count for count, _ in cost.traffic.values())


def figures(scene, cost):
    """Each figure beside its goal, where it has one."""
    where = f"{cost.robots} x {SCENES[scene]}, {cost.routers} router{'s' if cost.routers > 1 else ''}"
    yield Result(f"{where}: control period p50", cost.period_p50_ms, "ms")
    yield Result(f"{where}: control period p99", cost.period_p99_ms, "ms")
    yield Result(f"{where}: late control ticks", 100.0 * cost.late, "%", LATE_GOAL)
    yield Result(f"{where}: sample to command p50", cost.latency_p50_ms, "ms")
    yield Result(f"{where}: sample to command p99", cost.latency_p99_ms, "ms")
    yield Result(f"{where}: processor of a robot", 100.0 * cost.processor, "% of a core")
    yield Result(f"{where}: memory of a robot (shared pages parted)", cost.memory_mb, "MB")
    yield Result(f"{where}: processor of the routers", 100.0 * cost.routing, "% of a core")
    yield Result(f"{where}: messages a second", passed(cost), "Hz")
    yield Result(f"{where}: routers' processor a message", 1e6 * cost.routing / max(passed(cost), 1.0), "us")


def traffic(scene, cost):
    """What one robot and its operator say: bytes a message by topic, and all of it at the rates of the table."""
    sizes = {name: size / rate for name, (rate, size) in cost.traffic.items()}
    for name, size in sorted(sizes.items()):
        yield Result(f"{SCENES[scene]}, {name}: payload of a message", size, "byte")
    total = sum(sizes.get(topic.name, 0.0) * topic.rate_hz for topic in TOPICS)
    yield Result(f"{SCENES[scene]}: payload of these, at the rates of the table", total / 1e3, "kB/s")


def company(trials, turns, seconds):
    """Presence across two routers, and a robot that fifty observers look at."""
    with tempfile.TemporaryDirectory() as name, Fleet(Path(name), "particle") as fleet:
        fleet.grow(1)
        with fleet.operated() as _:
            yield from looking.watched(fleet, turns, seconds)
        fleet.join()
        yield from presence.measure(fleet, trials)


def told(results):
    """Print each as it comes, and keep them."""
    kept = []
    for one in results:
        print(f"{one.name:<66} {one.value:10.3f} {one.unit}   {one.verdict}".rstrip(), flush=True)
        kept.append(one)
    return kept


def loaded(when):
    """How busy the machine is."""
    return Result(f"load average {when}", os.getloadavg()[0], "")


def run(*, counts, scenes, seconds, trials, turns, sites, company_too):
    """Everything, one after the other."""
    yield loaded("before")
    for scene in scenes:
        for number, cost in enumerate(growth(scene, counts, seconds)):
            yield from figures(scene, cost)
            if number == 0:
                yield from traffic(scene, cost)
        yield loaded(f"after {SCENES[scene]}s, this benchmark's own included")
    if company_too:
        yield from company(trials, turns, seconds)
        yield loaded("after presence and observers")
        yield from rules.measure(sites)


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="deploy/bench fleet", description=__doc__)
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON")
    parser.add_argument("--quick", action="store_true", help="a robot or two for a moment: does it work at all?")
    parser.add_argument("--most", type=int, default=COUNTS[-1], metavar="N", help="no more robots at once than these")
    parser.add_argument("--scene", choices=SCENES, help="only these robots, and nothing but their growth")
    options = parser.parse_args(arguments)
    leave_on_signals()  # whatever was started goes, too
    if options.json is not None and not options.json.parent.is_dir():
        parser.error(f"--json: the folder {options.json.parent} does not exist")
    if options.most < 1:
        parser.error("--most: give at least 1")
    print(f"bench: about {'two minutes' if options.quick else 'ten minutes'}", file=sys.stderr)
    scenes = (options.scene,) if options.scene else tuple(SCENES)
    counts = tuple(count for count in COUNTS if count <= options.most)
    plan = {"counts": counts, "scenes": scenes, "seconds": 10.0, "trials": 5, "turns": 5, "sites": rules.SITES}
    if options.quick:
        plan = {"counts": (1, 2), "scenes": scenes[:1], "seconds": 2.0, "trials": 1, "turns": 1, "sites": (1,)}
    try:
        results = told(run(**plan, company_too=not options.scene))
    except AssertionError as error:  # of what is waited for
        raise SystemExit(f"bench: {error}") from None
    if options.json is not None:
        write_json(options.json, results)


if __name__ == "__main__":
    main()
