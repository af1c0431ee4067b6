"""What the robot writes down about itself, as it happens; see `services.evidence`."""

from __future__ import annotations

import platform
import sys
from typing import Any

import msgspec

from protocol.messages import Prediction
from services.evidence.events import AuthorityChanged, Began, Commanded, EpisodeBegan, EpisodeEnded, StopChanged
from services.evidence.ledger import Ledger
from services.process.config import Configuration
from services.process.release import versions
from services.robot.control import Control
from services.robot.order import Finished

SOFTWARE = ("retouch", "eclipse-zenoh", "msgspec", "mujoco", "numpy", "pin")
"""Distributions whose versions are kept."""


class Evidence:
    """Sees what changes, and writes it down.

    Args:
        ledger: where to.
        control: that it looks at.
    """

    def __init__(self, ledger: Ledger, control: Control) -> None:
        self._ledger = ledger
        self._control = control
        self._epoch = control.lease.epoch
        self._latch = control.latch
        self._finished: Finished | None = None

    def commanded(self, request: msgspec.Struct, asker: str) -> None:
        """A request was carried out."""
        said: dict[str, Any] = msgspec.to_builtins(request)
        self._ledger.add(Commanded(request=type(request).__name__, asker=asker[:64], said=said))

    def set_in_motion(self, predicted: Prediction | None) -> None:
        """An episode has begun: with this prediction, or led by a hand where there is none."""
        order, lease = self._control.order, self._control.lease
        if order is None:
            return
        self._ledger.add(
            EpisodeBegan(
                episode=order.episode,
                epoch=lease.epoch,
                operator=order.who,
                mode=order.mode,
                prediction=order.prediction,
                origin=predicted.origin if predicted is not None else None,
                model_version=predicted.model_version if predicted is not None else None,
            )
        )

    def look(self) -> None:
        """Write down what changed since the last look: authority, stop, an episode's end."""
        control = self._control
        if control.latch is not self._latch:
            self._latch = latch = control.latch
            self._ledger.add(
                StopChanged(latched=latch.latched, by=latch.by, reason=latch.reason, released_by=latch.released_by)
            )
        if control.finished is not self._finished:
            self._finished = control.finished
            if control.finished is not None:
                self._ledger.add(_ended(control.finished))
        if control.lease.epoch != self._epoch:
            self._epoch = control.lease.epoch
            self._ledger.add(_authority(control))


def began(configuration: Configuration) -> Began:
    """The process did, under these settings."""
    settings = {
        "connect": configuration.connect,
        "insecure": configuration.insecure,
        "robot": msgspec.to_builtins(configuration.robot),
    }
    return Began(robot=configuration.name, host=platform.node()[:64], versions=software(), settings=settings)


def software() -> dict[str, str]:
    """Versions of what moves the robot."""
    return {"platform": sys.platform, **versions(SOFTWARE)}


def _authority(control: Control) -> AuthorityChanged:
    lease = control.lease
    return AuthorityChanged(
        epoch=lease.epoch,
        event=lease.event,
        holder=lease.holder,
        operator=lease.operator,
        by=lease.by,
        before=lease.before,
        reason=lease.reason,
    )


def _ended(finished: Finished) -> EpisodeEnded:
    order, outcome = finished.order, finished.outcome
    return EpisodeEnded(
        episode=order.episode,
        operator=order.who,
        corrected=outcome.operator_input,
        success=outcome.verdict.success,
        cut=outcome.cut,
        reason=outcome.reason,
        progress=round(outcome.progress, 4),
        duration=round(outcome.duration, 3),
        held=round(outcome.held, 3),
        clamped=outcome.clamped,
    )
