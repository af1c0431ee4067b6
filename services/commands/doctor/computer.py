"""This computer itself: what is late may be so because of it, and not because of the way."""

from __future__ import annotations

from collections.abc import Iterator

from services.commands.doctor.case import Case
from services.commands.doctor.finding import Finding, look

COMPUTER = "computer"


def check_computer(case: Case) -> Iterator[Finding]:
    """Whether it has more to do than it can; nothing where it has not, or that is not known."""
    load = case.load()
    if load is not None and load.is_too_much:
        programs, processors = round(load.wanting), load.processors
        told = f"too busy: {programs} programs want its {processors} processor{'s' if processors > 1 else ''}"
        yield look(COMPUTER, f"{told}; motions will hold", "end what else runs here")
