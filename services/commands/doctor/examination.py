"""The checks in their order, and which of them could not be made because an earlier one failed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from services.commands.doctor.case import Case
from services.commands.doctor.certificate import check_certificate
from services.commands.doctor.computer import COMPUTER, check_computer
from services.commands.doctor.entitlement import RIGHTS, check_rights
from services.commands.doctor.finding import Finding, Verdict
from services.commands.doctor.own import CERTIFICATE
from services.commands.doctor.pictures import PICTURES, check_pictures
from services.commands.doctor.place import NAME, PORT, check_name, check_port
from services.commands.doctor.processes import PROCESSES, SOFTWARE, check_processes, check_version
from services.commands.doctor.router import ENTRY, ROUTER, check_entry, check_router
from services.commands.doctor.times import CLOCK, check_clock
from services.commands.doctor.way import WAY, check_way


@dataclass(frozen=True)
class Check:
    """One check.

    Attributes:
        name: as its findings are called.
        make: makes it; a finding a line.
        needs: without these it cannot be made.
    """

    name: str
    make: Callable[[Case], Iterator[Finding]]
    needs: tuple[str, ...] = ()


CHECKS = (
    Check(COMPUTER, check_computer),
    Check(NAME, check_name),
    Check(PORT, check_port, needs=(NAME,)),
    Check(CERTIFICATE, check_certificate),
    Check(ROUTER, check_router, needs=(PORT, CERTIFICATE)),
    Check(ENTRY, check_entry, needs=(ROUTER,)),
    Check(PROCESSES, check_processes, needs=(ENTRY,)),
    Check(SOFTWARE, check_version, needs=(ENTRY,)),
    Check(CLOCK, check_clock, needs=(PROCESSES,)),
    Check(WAY, check_way, needs=(ENTRY,)),
    Check(PICTURES, check_pictures, needs=(ENTRY,)),
    Check(RIGHTS, check_rights, needs=(ENTRY,)),
)


def examine(case: Case) -> Iterator[Finding]:
    """What the checks find, as they find it.

    Raises:
        KeyboardInterrupt: somebody ended the command.
    """
    cause: dict[str, str] = {}
    for check in CHECKS:
        without = [name for name in check.needs if name in cause]
        if without:
            cause[check.name] = cause[without[0]]
            continue
        for finding in check.make(case):
            if finding.verdict is Verdict.WRONG:
                cause[check.name] = check.name
            yield finding
    for failed in dict.fromkeys(cause.values()):
        missing = [name for name, why in cause.items() if why == failed and name != failed]
        if missing:
            yield Finding(Verdict.NOT_MADE, ", ".join(missing), f"what is wrong with the {failed} comes first")
