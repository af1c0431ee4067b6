"""How far the first motions of an empty skill have been shown. A pure value."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Guide:
    """See the module.

    Attributes:
        open: the skill is to be shown a motion, or another one.
        kept: first motions that the skill holds.
        passed: places that the operator did not want, since the last motion was kept.
        put: the target stands at this place, and was seen there.
        tries: how often a hand has led the robot at this place.
        enough: the operator goes on with the motions that there are.
    """

    open: bool = False
    kept: int = 0
    passed: int = 0
    put: bool = False
    tries: int = 0
    enough: bool = False

    def holding(self, demonstrations: int, updates: int, places: int) -> Guide:
        """As the skill is now.

        Args:
            demonstrations: first ones that it holds.
            updates: that it has learnt since.
            places: that are shown.
        """
        enough = self.enough and demonstrations > 0
        opens = demonstrations < places and not updates and not enough
        if opens and self.open and demonstrations <= self.kept:
            return replace(self, kept=demonstrations, enough=enough)
        return Guide(open=opens, kept=demonstrations, enough=enough)

    def looked(self, *, put: bool) -> Guide:
        """Once the target was seen, and whether it had been put there."""
        return replace(self, put=self.open and (put or self.put))
