"""`retouch prepare`: makes and keeps what every simulated run needs, so that none waits for it."""

from __future__ import annotations

import logging
from argparse import ArgumentParser, Namespace

from services.commands.arguments import add_debug
from services.offline.first_demonstrations import first_demonstrations
from sim.tasks import SCENES

log = logging.getLogger(__name__)


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """The simulated robot, and the first demonstrations of all scenes; see `Action`."""
    del arguments
    for scene in SCENES.values():
        first_demonstrations(scene)
    log.info("the simulated robot and %d scenes are ready", len(SCENES))
    return 0
