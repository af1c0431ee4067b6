"""`retouch certs`: an authority of one's own, and certificates for processes, routers and people."""

from __future__ import annotations

import json
import sys
from argparse import ArgumentParser, Namespace, _SubParsersAction
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

from protocol.rights import KINDS, SITE
from services.bus.zenoh.access import access_control, quotas
from services.certificates import register
from services.certificates.authority import DAYS, Authority, make_authority
from services.certificates.credentials import folder
from services.certificates.register import Issued
from services.commands.arguments import add_debug, whole

_ABOUT = f"""\
A certificate says who somebody is. Its name is KIND.NAME: {", ".join(SITE)} of a
robot, {", ".join(kind.name for kind in KINDS if kind.person)} for a person; site.ROBOT is all that a robot's
site needs, page.NAME what a page needs that browsers of others open. The authority's
folder stays where it is; what --to names is copied to the machine that it is for, as
its ~/.config/retouch/certs.

  retouch certs init
  retouch certs issue operator.anna --to anna
  retouch certs issue page.desk --host desk.lan --to anna
  retouch certs issue site.kitchen --host 192.0.2.1 --to kitchen
"""

_SITE = "site"

_DIALLED = tuple(f"{kind.name}." for kind in KINDS if kind.dialled)


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = _ABOUT
    add_debug(parser)
    parts = parser.add_subparsers(dest="part", required=True, metavar="PART")
    _part(parts, "init", "make an authority; one that is there stays")
    issue = _part(parts, "issue", "make the first certificates of these names", named=True)
    issue.add_argument(
        "--host", action="append", default=[], metavar="H", help="name or address at which a router or page is reached"
    )
    renew = _part(parts, "renew", "make new ones in their place, used from the next connection on", named=True)
    for part in (issue, renew):
        part.add_argument("--days", type=whole(1), default=DAYS, metavar="N", help=f"they last (default: {DAYS})")
        part.add_argument("--to", type=Path, metavar="FOLDER", help="of the machine that they are for")
    _part(parts, "revoke", "let them count no more, at every router that has the new issued.json", named=True)
    _part(parts, "list", "who has which, for what, until when")
    _part(parts, "rules", "what a router lets whom do, as the official zenohd reads it, too")


def _part(parts: _SubParsersAction[ArgumentParser], name: str, about: str, *, named: bool = False) -> ArgumentParser:
    part = parts.add_parser(name, help=about, description=about)
    if named:
        part.add_argument("names", nargs="+", metavar="KIND.NAME")
    part.add_argument(
        "--folder", default="", metavar="FOLDER", help="the authority's (default: ~/.config/retouch/certs)"
    )
    return part


def run(arguments: Namespace) -> int:
    """See `Action`."""
    where = folder(arguments.folder)
    match arguments.part:
        case "init":
            make_authority(where)
            _say(f"the authority is in {where}; whoever has its ca.key can make certificates: keep it to yourself")
        case "issue":
            authority = Authority(where)
            for name in _all(arguments.names):
                hosts = arguments.host if name.startswith(_DIALLED) else ()
                _made(authority.issue(name, arguments.days, hosts, arguments.to), arguments.to or where)
        case "renew":
            authority = Authority(where)
            for name in _all(arguments.names):
                _made(authority.renew(name, arguments.days, arguments.to), arguments.to or where)
        case "revoke":
            authority = Authority(where)
            for name in _all(arguments.names):
                authority.revoke(name)
                _say(f"{name} counts no more at routers that have {where / register.REGISTER}: copy it to theirs")
        case "list":
            at = register.now()
            for one in register.load(where).issued:
                _say(_row(one, at))
        case "rules":
            _say(json.dumps(_rules(where), indent=2))
    return 0


def _all(names: list[str]) -> list[str]:
    """The names, a site's spelt out."""
    spelt = []
    for name in names:
        kind, _, robot = name.partition(".")
        spelt += [f"{one}.{robot}" for one in SITE] if kind == _SITE and robot else [name]
    return spelt


def _made(issued: Issued, where: Path) -> None:
    _say(f"{where / issued.name}.pem until {issued.until:%Y-%m-%d %H:%M} UTC")


def _row(one: Issued, at: datetime) -> str:
    """Who has it, for what, until when."""
    if one.revoked is not None:
        state = f"revoked on {one.revoked:%Y-%m-%d %H:%M}"
    elif one.until <= at:
        state = "ended"
    else:
        state = f"{(one.until - at) / timedelta(days=1):.1f} days left"
    kind = one.subject.kind
    use = "routes" if kind.routes else "serves a page" if kind.page else " ".join(kind.roles)
    where = f"  at {' '.join(one.hosts)}" if one.hosts else ""
    return f"{one.name:<24}  until {one.until:%Y-%m-%d %H:%M} UTC, {state:<28}  {use}{where}"


def _rules(where: Path) -> dict[str, Any]:
    subjects = [(one.common_name, one.subject) for one in register.load(where).admitted()]
    return {"access_control": access_control(subjects), **quotas(subjects)}


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
