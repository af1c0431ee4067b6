"""Who takes part in a rehearsal: nobody. So many simulated participants are enrolled, marked as such."""

from __future__ import annotations

from dataclasses import dataclass

from services.study.session.conductor import Conductor


@dataclass(frozen=True)
class Rehearsal:
    """Of a study.

    Attributes:
        people: how many take part.
        seed: of all of them.
    """

    people: int
    seed: int = 0

    def enrol(self, conductor: Conductor) -> None:
        """Enrol those who are not enrolled yet, by turns in the study's languages.

        Args:
            conductor: of the study.

        Raises:
            CannotWrite: it is not written down.
        """
        known, languages = conductor.participants(), conductor.protocol.languages
        for number in range(1, self.people + 1):
            if number not in known:
                language = languages[(number - 1) % len(languages)]
                conductor.enrol(number, language, synthetic=True, seed=self.seed + number)
