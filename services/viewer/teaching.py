"""Where the teaching stands, and what the model is that teaches and is taught."""

from __future__ import annotations

import rerun as rr

from protocol.messages import Attempt, Prediction, TeachingState
from protocol.topics import MODEL_STATE, TEACHING_STATE
from services.bus.bus import Bus
from services.viewer import entities, motions
from services.viewer.journal import Journal, whose
from services.viewer.news import Changes, News
from services.viewer.run import Run
from services.viewer.words import Words

# The table is drawn again this often: neither who comes late nor a recording's next file has it yet.
_REPEAT_S = 30.0


class Teaching:
    """Draws the teaching of a run.

    Args:
        bus: to whoever teaches and learns.
        run: where it is drawn.
        words: of the run.
        journal: that words are written from.
    """

    def __init__(self, bus: Bus, run: Run, words: Words, journal: Journal) -> None:
        self._run, self._words, self._journal = run, words, journal
        self._teaching = News(bus.subscribe(TEACHING_STATE))
        self._model = News(bus.subscribe(MODEL_STATE))
        self._changes = Changes(_REPEAT_S)

    def draw(self, shown: Prediction | None, now_ns: int) -> None:
        """Draw what is new; `shown` is the prediction that is seen, None where there is none."""
        model, teaching = self._model.take(now_ns), self._teaching.take(now_ns)
        if model is not None:
            learnt = f"{model.kind} {model.version}: {model.demonstrations} shown, {model.updates} learnt since"
            self._words.state(entities.MODEL, learnt, now_ns)
        if shown is not None:
            self._words.state(entities.SHOWN, whose(shown), now_ns)
            self._words.write(*self._journal.prediction(shown))
        if teaching is None:
            return
        self._words.state(entities.TEACHING, teaching.phase, now_ns)
        self._words.state(entities.ATTEMPT, attempt(teaching), now_ns)
        self._words.write(*self._journal.teaching(teaching, now_ns))
        if self._changes.due("waypoints", teaching.waypoints, now_ns):
            motions.log_waypoints(self._run, teaching.waypoints)
        if self._changes.due("attempts", teaching.attempts, now_ns):
            document = rr.TextDocument(table(teaching.attempts), media_type=rr.MediaType.MARKDOWN)
            self._run.log(entities.ATTEMPTS, document)


def attempt(teaching: TeachingState) -> str:
    """Which attempt and which update of a run this is; empty where they are not counted."""
    if not teaching.refinements_allowed:
        return ""
    attempts = f"attempts {teaching.refinements} of {teaching.refinements_allowed}"
    return f"{attempts}, updates {teaching.updates} of {teaching.updates_allowed}"


def table(attempts: tuple[Attempt, ...]) -> str:
    """The episodes of a run as a table in Markdown, the newest first."""
    if not attempts:
        return "No episode yet."
    head = "| # | who shaped it | model version | came to | s |\n|---|---|---|---|---|\n"
    return head + "".join(
        f"| {one.number} | {one.mode.value}{', by hand' if one.operator_input else ''} | {one.model_version} "
        f"| {_outcome(one)} | {one.duration_s:.1f} |\n"
        for one in reversed(attempts)
    )


def _outcome(one: Attempt) -> str:
    verdict = one.verdict
    faults = [name for name, is_so in (("collision", verdict.collision), ("kicked over", verdict.kicked_over)) if is_so]
    return ", ".join(["reached" if verdict.reached else "not reached", *faults])
