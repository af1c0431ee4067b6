"""The reproduction's failures.

ReproductionError
├── UnknownAnalysis  a name that no analysis has
├── CannotKeep       a folder that results cannot be kept in (an EnvironmentFault too)
└── NothingToMap     a model that cannot be mapped
"""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from pathlib import Path

from services.process.exceptions import EnvironmentFault, ServiceError


class ReproductionError(ServiceError):
    """Base of what the reproduction raises for a person to read."""


class UnknownAnalysis(ReproductionError):
    """There is no analysis of that name."""

    def __init__(self, name: str, known: Sequence[str]) -> None:
        self.name = name
        near = difflib.get_close_matches(name, known, n=3, cutoff=0.4)
        hint = f"did you mean {' or '.join(near)}?" if near else "see 'retouch reproduce --list'"
        super().__init__(f"no analysis is called {name!r}; {hint}")


class CannotKeep(ReproductionError, EnvironmentFault):
    """Results cannot be written."""

    def __init__(self, folder: Path, reason: str, flag: str = "--out") -> None:
        self.folder = folder
        super().__init__(f"cannot keep results in {folder}: {reason}; choose another folder with {flag}")


class NothingToMap(ReproductionError):
    """The model's success cannot be mapped."""
