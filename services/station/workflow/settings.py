"""What does not change in a run, and what of it is not the operator's choice. A pure value."""

from __future__ import annotations

from dataclasses import dataclass

from protocol.messages import Method, Mode
from protocol.queries import Adapt, Reset
from services.station.workflow.action import CHANGES, Action


@dataclass(frozen=True)
class Settings:
    """What does not change in a run.

    Attributes:
        holder: this station's name, for the authority.
        operator: the person at this station.
        autonomous_s: duration of an autonomous execution [s].
        refine_s: duration of an execution under correction [s].
        refinements_allowed: attempts at one update.
        updates_allowed: updates at one place.
        adapt: which way-point a correction moves.
        alpha: how far the model believes a refinement (eq. 18).
        points: of a demonstration that is learnt.
        keeps_tempo: a demonstration is learnt in the tempo in which it was led, else evenly along its way.
        variant: arrangement of the scene that the run is about; empty for the one that was changed.
        scripted: the recommended action is taken at once; a stop is never released.
        untaught: a script shows an empty skill its first motion.
        once: the recommended action after the loop has closed is to end.
        place: of the target in every episode, as the scene counts it; empty where it is drawn.
        method: the only one; `UNKNOWN` where the operator chooses.
        basis: the only one that a refinement starts from, by its name; empty where the operator chooses.
        fixed: the operator changes neither a motion's pace nor the confidence, nor takes anything back.
        executions: a script executes so often, each time at another place, and teaches nothing; 0 where it teaches.
        arrangement: what every reset asks for, its epoch aside; drawn at random where there is none.
    """

    holder: str
    operator: str
    autonomous_s: float
    refine_s: float
    refinements_allowed: int
    updates_allowed: int
    adapt: Adapt
    alpha: float
    variant: str
    scripted: bool
    once: bool
    points: int = 75
    keeps_tempo: bool = False
    untaught: bool = False
    place: tuple[float, ...] = ()
    method: Method = Method.UNKNOWN
    basis: str = ""
    fixed: bool = False
    executions: int = 0
    arrangement: Reset | None = None

    @property
    def settled(self) -> frozenset[Action]:
        """What is not the operator's choice; with one place there is no other, and who has set it ends the run."""
        method = frozenset({Action.METHOD} if self.method is not Method.UNKNOWN else ())
        basis = frozenset({Action.BASIS} if self.basis else ())
        place = frozenset({Action.NEXT, Action.END} if self.place else ())
        return method | basis | place | (CHANGES if self.fixed else frozenset())

    @property
    def guides(self) -> bool:
        """Whoever operates shows an empty skill its first motions; nobody does where all is set beforehand."""
        operates = self.untaught or not self.scripted
        return operates and not self.executions and not self.place and self.arrangement is None

    def duration_s(self, mode: Mode) -> float:
        """Of an execution [s]."""
        return self.refine_s if mode is Mode.REFINE else self.autonomous_s
