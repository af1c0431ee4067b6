"""Who may command, what is held at that person's page, and what the hand does with the master."""

from __future__ import annotations

from protocol.messages import AuthorityState, OperatorInput
from protocol.topics import AUTHORITY_STATE, MASTER_STATE, OPERATOR_INPUT
from services.bus.bus import Bus
from services.viewer import entities, scene, series
from services.viewer.journal import Journal
from services.viewer.news import Changes, News, NewsOfHolder
from services.viewer.run import Run
from services.viewer.words import Words

# The force's arrow: every second step, since nobody sees more and each costs as much as a joint.
_ARROW_S = 0.06


class Teleoperation:
    """Draws the operator's side of a run; of several operators, the one who may command.

    Args:
        bus: to them.
        run: where it is drawn.
        words: of the run.
        journal: that words are written from.
    """

    def __init__(self, bus: Bus, run: Run, words: Words, journal: Journal) -> None:
        self._run, self._words, self._journal = run, words, journal
        self._authority = News(bus.subscribe(AUTHORITY_STATE))
        self._input = NewsOfHolder(bus.subscribe(OPERATOR_INPUT))
        self._master = NewsOfHolder(bus.subscribe(MASTER_STATE))
        self._pace = Changes(_ARROW_S)

    def draw(self, at: tuple[float, float, float] | None, now_ns: int) -> None:
        """Draw what is new.

        Args:
            at: where the hand is felt, the grasping frame's position [m]; None where it is not known.
            now_ns: the time [ns].
        """
        authority = self._authority.take(now_ns)
        if authority is not None:
            self._words.state(entities.AUTHORITY, who_commands(authority), now_ns)
            self._words.write(*self._journal.authority(who_commands(authority), now_ns))
        holder = self._authority.known.holder if self._authority.known is not None else ""
        held = self._input.take(holder)
        if held is not None:
            self._words.state(entities.KEYS, keys_held(held), now_ns)
            self._words.state(entities.PAGE, who_is_there(held), now_ns)
            series.log_axes(self._run, held.axes)
        master = self._master.take(holder)
        if master is None:
            return
        self._words.state(entities.ENGAGED, (master.device or "engaged") if master.engaged else "", now_ns)
        series.log_master(self._run, master)
        if at is not None and self._pace.due("force", (master.force, at), now_ns):
            scene.log_force(self._run, at, master.force)


def who_commands(authority: AuthorityState) -> str:
    """Who holds the authority, where, and its epoch; empty for nobody."""
    return f"{authority.operator} at {authority.holder}, epoch {authority.epoch}" if authority.holder else ""


def keys_held(held: OperatorInput) -> str:
    """The keys that are held down, by their places; empty where none is."""
    return " + ".join(key.removeprefix("Key") for key in held.keys)


def who_is_there(held: OperatorInput) -> str:
    """Who is at the page, and whether keys count there; empty where nobody is."""
    if not held.present:
        return ""
    return held.operator if held.focused else f"{held.operator}, the keys elsewhere"
