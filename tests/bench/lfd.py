"""Learning from demonstration: movement primitives, time warping and growing models, beside other libraries.

Processor time of one thread; in each operation the contenders take turns. The ratio is to the first of them.
"""

import argparse
import sys
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from tests.bench.speed import attractors, growth, primitives, warping
from tests.bench.support.results import write_json
from tests.bench.support.timing import Effort, Timing

GROUPS = (primitives, attractors, warping, growth)


def table(results):
    """The lines to print, grouped by operation."""
    width = max(len(r.name) for r in results)
    operation = None
    for r in results:
        if not isinstance(r, Timing):
            yield f"{r.name:<{width + 2}} {r.value:11.3f} {r.unit}   {r.verdict}".rstrip()
            continue
        if r.operation != operation:
            operation = r.operation
            yield f"\n{operation:<{width + 2}} {'median ms':>11} {'p99 ms':>11} {'runs':>6} {'ratio':>8}"
        if r.runs == 0:
            yield f"  {r.name:<{width}} {r.note:>11}"
        else:
            figures = f"{r.value:11.4f} {r.p99:11.4f} {r.runs:6d} {r.ratio:8.2f}"
            yield f"  {r.name:<{width}} {figures}   {'   '.join(filter(None, (r.verdict, r.note)))}".rstrip()


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="deploy/bench lfd", description=__doc__)
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures as JSON")
    parser.add_argument("--quick", action="store_true", help="a few runs of the small sizes: does it work at all?")
    parser.add_argument("--no-peers", action="store_true", help="without the other libraries")
    options = parser.parse_args(arguments)
    if options.json is not None and not options.json.parent.is_dir():
        parser.error(f"--json: the folder {options.json.parent} does not exist")
    effort = Effort(seconds=0.02 if options.quick else 1.0, large=not options.quick, peers=not options.no_peers)
    print(f"bench: about {'twenty seconds' if options.quick else 'six minutes'}", file=sys.stderr)
    results = []
    with threadpool_limits(1):  # as the processes of retouch have it
        for group in GROUPS:
            results += group.measure(np.random.default_rng(20210301), effort)
    print("\n".join(table(results)))
    if options.json is not None:
        write_json(options.json, results)


if __name__ == "__main__":
    main()
