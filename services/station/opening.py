"""Opens the operator's page as it is configured: where, under which certificate, for whom."""

from __future__ import annotations

import logging

from services.accounts.file import AccountsFile, accounts_path
from services.accounts.passwords import is_right
from services.accounts.policy import asks, page_is_open
from services.certificates.expiry import Expiry
from services.certificates.page import is_plain, of_page, secured
from services.process.clock import Clock
from services.process.config import Configuration
from services.process.load import load_now
from services.process.robots import camera_names, known_scene, manipulator
from services.station.live_view.description import describe
from services.station.page.login.judge import Judge
from services.station.page.page import Page

log = logging.getLogger(__name__)


def open_page(configuration: Configuration, clock: Clock) -> Page:
    """The page, served.

    Raises:
        Unsecured: others reach it, it has no certificate, and nobody said that it may be open.
        UnusableSetting: its certificate cannot be used.
        LoginImpossible: somebody should log in, and nobody can; or nobody has to where others reach it.
        AccountsUnreadable: the file of accounts holds something else.
        PortInUse: it cannot be served there.
    """
    judge = Judge(AccountsFile(accounts_path()), is_right) if asks(configuration) else None
    described = describe(known_scene(configuration.robot), manipulator(configuration.robot))
    served, robot = secured(configuration), configuration.name
    cameras = camera_names(configuration)
    page = Page(served, robot, clock, described, configuration.operator, judge=judge, load=load_now, cameras=cameras)
    page.start()
    if page_is_open(configuration):
        log.warning("the page is open to others (--insecure): %s", _why(configuration))
    own = of_page(configuration)
    if own is not None:
        Expiry(own).start()
    return page


def _why(configuration: Configuration) -> str:
    if is_plain(configuration):
        return "it is plain HTTP, and whoever is on its way reads passwords and commands"
    return "nobody has to log in, and whoever reaches it commands"
