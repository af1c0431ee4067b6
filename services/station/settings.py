"""The workflow's settings as a configuration has them."""

from __future__ import annotations

import secrets

from services.process.config import StationSection
from services.station.workflow.settings import Settings


def settings(section: StationSection, operator: str) -> Settings:
    """The workflow's settings as configured, for the person at this station."""
    return Settings(
        # A station that was restarted is another one: the robot ends what it does not know of.
        holder=f"station-{secrets.token_hex(2)}",
        operator=operator,
        autonomous_s=section.autonomous_s,
        refine_s=section.refine_s,
        refinements_allowed=section.refinements_allowed,
        updates_allowed=section.updates_allowed,
        adapt=section.adapt,
        alpha=section.alpha,
        variant=section.variant,
        place=section.place,
        method=section.method,
        basis=section.basis,
        fixed=section.fixed,
        scripted=section.scripted,
        once=section.once,
        executions=section.executions,
        untaught=section.untaught,
        points=section.demonstration_points,
        keeps_tempo=section.demonstration_tempo,
    )
