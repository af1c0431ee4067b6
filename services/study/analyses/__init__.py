"""All analyses, in the order of the report; each group has a file of its own.

A new one is a pure function `Context -> Finding` in a file here, an `Analysis` beside it, and its name in this tuple.
"""

from services.study.analyses.incremental import WELFORD
from services.study.analysis import Analysis

ANALYSES: tuple[Analysis, ...] = (WELFORD,)
