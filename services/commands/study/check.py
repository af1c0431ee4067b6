"""`retouch study check`: whether protocol and questionnaires agree with themselves and with what was frozen."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from services.commands.arguments import add_debug
from services.commands.terminal import Terminal
from services.process.exit_codes import Exit
from services.study import freezing
from services.study.protocol.orders import Allocation, orders
from services.study.readiness import ready
from services.study.session.course import course, participants
from services.study.study import Study, open_study


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = (
        "Reads protocol and questionnaires, says what contradicts itself, and what each participant will go through;"
        " of a frozen study, what has changed since; of one that runs, how far each participant is."
    )
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of the study")
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    study = open_study(arguments.folder)
    ready(study)
    say = Terminal(highlight=False, soft_wrap=True).print
    for line in (*_design(study), *_frozen(study), *_people(study)):
        say(line, markup=False)
    return Exit.DONE


def _design(study: Study) -> list[str]:
    protocol = study.protocol
    rows = orders(protocol.order, [method.name for method in protocol.methods])
    allocation = list(Allocation(protocol.order, len(rows)).table())
    each = [allocation.count(group) for group in range(len(rows))]
    count = len(protocol.analysis.hypotheses)
    return [
        f"{protocol.title}: protocol {protocol.name}, version {protocol.version}, in {', '.join(protocol.languages)}",
        f"{protocol.order.participants} participants; {len(rows)} orders of {len(protocol.methods)} methods, of each"
        f" {min(each)}" + (f" to {max(each)}: not balanced" if min(each) != max(each) else ""),
        "a participant goes through: " + ", ".join(part.name for part in course(protocol, rows[0])),
        f"{count} {'hypothesis' if count == 1 else 'hypotheses'},"
        f" {sum(one.confirmatory for one in protocol.analysis.hypotheses)} of them confirmatory; rules"
        f" {protocol.analysis.rules}",
    ]


def _frozen(study: Study) -> list[str]:
    frozen = study.frozen()
    if frozen is None:
        return [f"not frozen: 'retouch study freeze {study.folder}' before people take part"]
    changed = freezing.changed(frozen, study.now())
    return [f"frozen at {frozen.at}" + (f"; changed since: {', '.join(changed)}" if changed else ", and as it was")]


def _people(study: Study) -> list[str]:
    said = []
    for number, one in sorted(participants(study.entries()).items()):
        part = one.next(study.protocol)
        where = "has finished" if one.finished else one.gone or (f"comes to {part.name}" if part is not None else "")
        said.append(f"participant {number}{' (synthetic)' if one.enrolled.synthetic else ''}: {where}")
    return said
