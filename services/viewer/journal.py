"""What happened, in words: changes of phase, verdict and teaching, once each; what flickers, when it settles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from protocol.messages import (
    AuthorityEvent,
    AuthorityState,
    Origin,
    Phase,
    Prediction,
    RobotState,
    SafetyState,
    TeachingState,
    Verdict,
)
from services.bus.predictions import LITTLE, certainty

SETTLED_NS = 500_000_000
"""What changes sooner is only counted."""

AGAIN_NS = 3_000_000_000
"""What comes back soon after it was said is only counted, too, where it lasts no longer than this."""

SOON_NS = 10_000_000_000


class Entry(NamedTuple):
    """A line of the journal.

    Attributes:
        text: for people.
        level: "INFO", "WARN" or "ERROR".
    """

    text: str
    level: str


@dataclass
class _Pending:
    """What is not said yet, since when it has been so, and how often such a thing passed before it could be said."""

    text: str = ""
    since_ns: int = 0
    passed: int = 0
    wait_ns: int = 0
    told: dict[str, int] = field(default_factory=dict)
    """What was said, and when it was so last [ns]."""


class Journal:
    """Remembers what was said, and says what is new."""

    def __init__(self) -> None:
        self._said: dict[str, str] = {}
        self._pending: dict[str, _Pending] = {}

    def robot(self, state: RobotState, now_ns: int) -> Iterator[Entry]:
        """What is new about the robot."""
        phase = f"robot: {state.phase.value}" + (f", episode {state.episode}" if state.episode else "")
        if state.phase is Phase.STOPPED:
            yield from self._changed("robot", Entry(phase, "ERROR"))
            return
        text = f"{phase}: {state.hold_reason}" if state.hold_reason else phase
        yield from self._settled("robot", Entry(text, "INFO"), now_ns)

    def safety(self, state: SafetyState) -> Iterator[Entry]:
        """What is new about the emergency stop."""
        if state.emergency_stop:
            text = f"emergency stop by {state.by}" + (f": {state.reason}" if state.reason else "")
            yield from self._changed("stop", Entry(text, "ERROR"))
        elif "stop" in self._said:
            yield from self._changed("stop", Entry(f"emergency stop released by {state.released_by}", "WARN"))

    def authority(self, state: AuthorityState, now_ns: int) -> Iterator[Entry]:
        """What is new about who may command, and how that came to be."""
        text = f"authority: {who_commands(state) or 'nobody'}"
        if state.event is not AuthorityEvent.NONE:
            text += f", {state.event.value.replace('_', ' ')}"
        if state.reason:
            text += f" by {state.by}: {state.reason}"
        yield from self._settled("authority", Entry(text, "INFO"), now_ns)

    def verdict(self, verdict: Verdict, now_ns: int) -> Iterator[Entry]:
        """What is new about the criteria."""
        collision = f"collision, {verdict.collision_force:.0f} N" if verdict.collision else "no collision"
        yield from self._changed("collision", Entry(collision, "ERROR" if verdict.collision else "INFO"))
        kicked = "object kicked over" if verdict.kicked_over else "object in place"
        yield from self._changed("kicked", Entry(kicked, "ERROR" if verdict.kicked_over else "INFO"))
        reached = "object reached" if verdict.reached else "object not reached"
        yield from self._settled("reached", Entry(reached, "INFO"), now_ns)

    def prediction(self, prediction: Prediction) -> Iterator[Entry]:
        """What is new about how sure the model is."""
        text = f"prediction of {whose(prediction)}"
        yield from self._changed("prediction", Entry(text, "WARN" if prediction.known < LITTLE else "INFO"))

    def teaching(self, state: TeachingState, now_ns: int) -> Iterator[Entry]:
        """What is new about the teaching."""
        yield from self._settled("teaching", Entry(f"{state.phase}: {state.told}", "INFO"), now_ns, settled_ns=0)
        if state.reason:
            yield from self._changed("reason", Entry(state.reason, "WARN"))

    def _settled(self, subject: str, entry: Entry, now_ns: int, settled_ns: int = SETTLED_NS) -> Iterator[Entry]:
        """The entry where it has been so for a while: a robot that holds for moments would fill the journal."""
        pending = self._pending.setdefault(subject, _Pending())
        said = self._said.get(subject)
        if entry.text != pending.text:
            pending.passed += pending.text not in ("", said)
            soon = now_ns - pending.told.get(entry.text, now_ns - SOON_NS) < SOON_NS
            pending.text, pending.since_ns, pending.wait_ns = entry.text, now_ns, AGAIN_NS if soon else settled_ns
        if entry.text in pending.told:
            pending.told[entry.text] = now_ns
        if entry.text == said or (said is not None and now_ns - pending.since_ns < pending.wait_ns):
            return
        self._said[subject] = entry.text
        pending.told = {text: ns for text, ns in pending.told.items() if now_ns - ns < SOON_NS} | {entry.text: now_ns}
        moments, pending.passed = pending.passed, 0
        yield entry._replace(text=f"{entry.text} (after {moments} changes of a moment)") if moments else entry

    def _changed(self, subject: str, entry: Entry) -> Iterator[Entry]:
        if self._said.get(subject) != entry.text:
            self._said[subject] = entry.text
            yield entry


def whose(prediction: Prediction) -> str:
    """Where a prediction comes from: the model in some version, and how sure that is; or what an operator showed."""
    version = f"model version {prediction.model_version}"
    if prediction.origin is Origin.MODEL:
        return f"{version}: {certainty(prediction)}"
    return f"{prediction.origin.value}, {version}"


def who_commands(authority: AuthorityState) -> str:
    """Who holds the authority, where, and its epoch; empty for nobody."""
    return f"{authority.operator} at {authority.holder}, epoch {authority.epoch}" if authority.holder else ""
