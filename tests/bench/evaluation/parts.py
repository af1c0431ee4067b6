"""Which recordings options may be chosen on, and which are for reporting only.

A set of demonstrations belongs to one part as a whole, and so does everything that one person refined: conditions of
one set, and refinements of one person, are too much alike to be kept apart. Sets and persons go by their names, the
first half to tuning; of an odd number the one in the middle is for reporting.
"""

from dataclasses import dataclass
from enum import StrEnum


class Part(StrEnum):
    """What of a folder is used."""

    TUNE = "tune"
    REPORT = "report"
    ALL = "all"


@dataclass(frozen=True)
class Recordings:
    """Sets of demonstrations by name, and sequences of refinements."""

    sets: dict
    sequences: list

    @property
    def operators(self):
        return sorted({s.operator for s in self.sequences})

    def part(self, part):
        """Those of one part; `ALL` are both."""
        sets, operators = _chosen(self.sets, part), _chosen(self.operators, part)
        return Recordings(
            {name: self.sets[name] for name in sets}, [s for s in self.sequences if s.operator in operators]
        )


def _chosen(names, part):
    ordered = sorted(names)
    half = len(ordered) // 2
    return {Part.TUNE: ordered[:half], Part.REPORT: ordered[half:], Part.ALL: ordered}[part]
