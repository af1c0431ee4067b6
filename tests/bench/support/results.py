"""What a benchmark measured, beside its goal."""

import json
from dataclasses import asdict, dataclass


@dataclass(frozen=True)
class Result:
    """A measured figure beside its goal; `met` is None where there is no goal."""

    name: str
    value: float
    unit: str
    goal: float | None = None

    @property
    def met(self):
        return None if self.goal is None else bool(self.value <= self.goal)

    @property
    def verdict(self):
        return "" if self.goal is None else f"goal {self.goal:g}: {'met' if self.met else 'MISSED'}"


def write_json(path, results):
    path.write_text(json.dumps([{**asdict(r), "met": r.met} for r in results], indent=2) + "\n")


def report(results, path):
    """Print each figure beside its goal, and write them as JSON where a file is named."""
    width = max(len(r.name) for r in results)
    for r in results:
        print(f"{r.name:<{width}} {r.value:10.2f} {r.unit}   {r.verdict}".rstrip())
    if path is not None:
        write_json(path, results)
