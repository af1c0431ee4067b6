"""The log's entries in words, for whoever reads it at a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from protocol.messages import AuthorityEvent, Mode
from services.evidence.entry import Entry
from services.evidence.events import (
    AuthorityChanged,
    Began,
    Commanded,
    EpisodeBegan,
    EpisodeEnded,
    Event,
    Repaired,
    StopChanged,
)
from services.process.lines import readable

_SHAPED = {
    Mode.AUTONOMOUS: "by itself",
    Mode.REFINE: "under correction",
    Mode.TEACH: "led by hand",
}


class Teller:
    """Tells one entry after another; of settings and versions, what is new."""

    def __init__(self) -> None:
        self._before: dict[str, str] = {}

    def tell(self, entry: Entry | None) -> str:
        """An entry in one line; what was written by whoever, made printable."""
        if entry is None:
            return "an entry that this version of Retouch does not know"
        return readable(self._began(entry.event) if isinstance(entry.event, Began) else _told(entry.event))

    def _began(self, began: Began) -> str:
        now = dict(_flat({"versions": began.versions, "settings": began.settings}))
        before, self._before = self._before, now
        if not before:
            software = ", ".join(f"{name} {version}" for name, version in began.versions.items())
            return f"{began.robot} began on {began.host}: {software}"
        changes = [
            f"{key}: {before.get(key, 'none')}, now {now.get(key, 'none')}"
            for key in sorted(before.keys() | now.keys())
            if before.get(key) != now.get(key)
        ]
        return f"{began.robot} began on {began.host}, " + ("; ".join(changes) or "settings and versions as before")


def _told(event: Event) -> str:
    told = ""
    match event:
        case AuthorityChanged():
            reason = f": {event.reason}" if event.reason else ""
            told = f"{_authority(event)}, epoch {event.epoch}{reason}"
        case Commanded():
            said = ", ".join(f"{key} {_short(value)}" for key, value in event.said.items() if key != "request")
            told = f"{event.asker} asked for {event.request}: {said}"
        case StopChanged(latched=True):
            told = f"EMERGENCY STOP by {event.by}" + (f": {event.reason}" if event.reason else "")
        case StopChanged():
            told = f"the emergency stop was released by {event.released_by}"
        case EpisodeBegan():
            of = f"model version {event.model_version}" if event.model_version is not None else "no model"
            origin = f" ({event.origin.value})" if event.origin is not None else ""
            told = f"episode {event.episode} of {event.operator}, {_SHAPED[event.mode]}, {of}{origin}"
        case EpisodeEnded():
            told = _ended(event)
        case Repaired():
            told = f"{event.size} bytes before this were not written to their end"
    return told


def _authority(changed: AuthorityChanged) -> str:
    who = changed.operator or changed.holder
    told = "nobody has the authority after the stop"
    match changed.event:
        case AuthorityEvent.ACQUIRED:
            told = f"{who} has the authority"
        case AuthorityEvent.TAKEN_OVER:
            told = f"{who} took the authority over from {changed.before}"
        case AuthorityEvent.GIVEN:
            told = f"{changed.before} gave the authority to {who}"
        case AuthorityEvent.GIVEN_BY_SILENCE:
            told = f"{changed.before} did not answer: {who} has the authority"
        case AuthorityEvent.RELEASED:
            told = f"{changed.by} gave the authority back"
        case AuthorityEvent.EXPIRED:
            told = f"{changed.by} was not heard any more: nobody has the authority"
        case AuthorityEvent.REVOKED:
            told = f"{changed.by} revoked {changed.before}'s authority"
    return told


def _ended(ended: EpisodeEnded) -> str:
    how = ended.reason or "to its end"
    result = "success" if ended.success else "no success"
    by = f"corrected by {ended.operator}" if ended.corrected else "not corrected"
    clamped = f", clamped in {ended.clamped} periods" if ended.clamped else ""
    held = f", held for {ended.held:.1f} s" if ended.held else ""
    return f"episode {ended.episode} ended: {how}; {result}, {by}, {ended.duration:.1f} s{held}{clamped}"


def _flat(settings: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, str]]:
    """Every setting by its path."""
    for key, value in settings.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{above}{key}.")
        else:
            yield f"{above}{key}", str(value)


def _short(value: Any) -> str:
    if isinstance(value, Mapping):
        return "(" + ", ".join(f"{key} {_short(each)}" for key, each in value.items()) + ")"
    if isinstance(value, list | tuple):
        return "(" + ", ".join(_short(each) for each in value) + ")"
    return f"{value:.4g}" if isinstance(value, float) else str(value)
