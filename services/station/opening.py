"""Opens the operator's page as it is configured: where, under which certificate."""

from __future__ import annotations

import logging

from services.certificates.expiry import Expiry
from services.certificates.page import is_plain, of_page, secured
from services.process.clock import Clock
from services.process.config import Configuration
from services.station.live_view.description import describe
from services.station.page.page import Page

log = logging.getLogger(__name__)


def open_page(configuration: Configuration, clock: Clock) -> Page:
    """The page, served.

    Raises:
        Unsecured: others reach it, it has no certificate, and nobody said that it may be open.
        UnusableSetting: its certificate cannot be used.
        PortInUse: it cannot be served there.
    """
    station = secured(configuration)
    page = Page(station, configuration.name, clock, describe(configuration.robot.scene), configuration.operator)
    page.start()
    if is_plain(configuration):
        log.warning("the page is plain HTTP and open to others (--insecure): whoever is on the way reads and commands")
    own = of_page(configuration)
    if own is not None:
        Expiry(own).start()
    return page
