"""The analysis' failures.

ServiceError
└── AnalysisError
    ├── NothingToAnalyse    observations that hold too little for any analysis
    ├── UnknownMethod       a hypothesis about a method that nobody used
    └── BadRenaming         a flag that renames what is not there, or twice
"""

from __future__ import annotations

from collections.abc import Sequence

from services.process.exceptions import ServiceError
from services.process.suggestion import right


class AnalysisError(ServiceError):
    """Base of what the analysis raises for a person to read."""


class NothingToAnalyse(AnalysisError):
    """The observations hold too little for any analysis."""


class UnknownMethod(AnalysisError):
    """A hypothesis is about a method that nobody used."""

    def __init__(self, hypothesis: str, method: str, known: Sequence[str]) -> None:
        self.method = method
        super().__init__(
            f"hypothesis {hypothesis!r} is about method {method!r}, which is not in the data: {right(method, known)};"
            " rename by --methods OURS=THEIRS, or give hypotheses of your own with --plan"
        )


class BadRenaming(AnalysisError):
    """A flag renames what is not there, or twice."""

    def __init__(self, flag: str, reason: str) -> None:
        super().__init__(f"{flag}: {reason}")
