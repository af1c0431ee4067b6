"""How far the first motions of an empty skill have been shown. A pure value."""

from __future__ import annotations

from dataclasses import dataclass, replace

from protocol.messages import ModelState


@dataclass(frozen=True)
class Guide:
    """See the module.

    Attributes:
        skill: that it is about, by its name.
        open: the skill is to be shown a motion, or another one.
        kept: first motions that the skill holds.
        passed: places that the operator did not want, since the last motion was kept.
        put: the target stands at this place, and was seen there.
        tries: how often a hand has led the robot at this place.
        enough: the operator goes on with the motions that there are.
    """

    skill: str = ""
    open: bool = False
    kept: int = 0
    passed: int = 0
    put: bool = False
    tries: int = 0
    enough: bool = False

    def holding(self, model: ModelState, places: int) -> Guide:
        """As the skill is now.

        Args:
            model: what it holds.
            places: that are shown.
        """
        kept, same = model.demonstrations, model.skill == self.skill
        enough = same and self.enough and kept > 0
        opens = kept < places and not model.updates and not enough
        if opens and self.open and same and kept <= self.kept:
            return replace(self, kept=kept, enough=enough)
        return Guide(skill=model.skill, open=opens, kept=kept, enough=enough)

    def looked(self, *, put: bool) -> Guide:
        """Once the target was seen, and whether it had been put there."""
        return replace(self, put=self.open and (put or self.put))
