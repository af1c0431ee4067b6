"""What is written down of a robot: who held the authority, commanded, stopped and corrected, and with what."""

from __future__ import annotations

from typing import Any

import msgspec

from protocol.messages import AuthorityEvent, Count, Cut, Mode, Name, Origin, Text


class _Event(msgspec.Struct, frozen=True, kw_only=True, tag_field="what", forbid_unknown_fields=True):
    """What all have in common: a name by which they are told apart."""


class Began(_Event, frozen=True, kw_only=True, tag="began"):
    """The robot's process did.

    Attributes:
        robot: its name.
        host: the machine.
        versions: of the software, by its name.
        settings: that it runs under, as in the configuration's file.
    """

    robot: Name
    host: Name
    versions: dict[str, str]
    settings: dict[str, Any]


class AuthorityChanged(_Event, frozen=True, kw_only=True, tag="authority"):
    """Another epoch; see `protocol.messages.AuthorityState`."""

    epoch: Count
    event: AuthorityEvent
    holder: Name
    operator: Name
    by: Name
    before: Name
    reason: Text


class Commanded(_Event, frozen=True, kw_only=True, tag="commanded"):
    """A request was carried out.

    Attributes:
        request: of which kind.
        asker: the process that asked, as the network knows it.
        said: all of it.
    """

    request: Name
    asker: Name
    said: dict[str, Any]


class StopChanged(_Event, frozen=True, kw_only=True, tag="stop"):
    """The emergency stop was latched, or released; see `protocol.messages.SafetyState`."""

    latched: bool
    by: Name
    reason: Text
    released_by: Name


class EpisodeBegan(_Event, frozen=True, kw_only=True, tag="episode"):
    """The robot was set in motion.

    Attributes:
        episode: counted since the process began.
        epoch: of the authority.
        operator: who holds it.
        mode: who shapes the motion.
        prediction: id of what is executed; 0 where the operator's hand leads alone.
        origin: where the motion comes from; None where the hand leads.
        model_version: of the model that predicted; None where the hand leads.
    """

    episode: Count
    epoch: Count
    operator: Name
    mode: Mode
    prediction: Count
    origin: Origin | None
    model_version: Count | None


class EpisodeEnded(_Event, frozen=True, kw_only=True, tag="ended"):
    """What became of it.

    Attributes:
        episode: its number.
        operator: who had asked for it.
        corrected: the operator's hand took part.
        success: by the robot's criteria.
        cut: what cut it short; None where it ran to its end.
        reason: the same for people.
        progress: share of the motion that was executed.
        duration: from the first motion to the verdict [s].
        held: of it, standing still [s].
        clamped: control periods in which something was clamped.
    """

    episode: Count
    operator: Name
    corrected: bool
    success: bool
    cut: Cut | None
    reason: Text
    progress: float
    duration: float
    held: float
    clamped: Count


class Repaired(_Event, frozen=True, kw_only=True, tag="repaired"):
    """What came before this was not written to its end: the power was cut, or the disk was full.

    Attributes:
        size: of it [bytes].
    """

    size: Count


Event = Began | AuthorityChanged | Commanded | StopChanged | EpisodeBegan | EpisodeEnded | Repaired
