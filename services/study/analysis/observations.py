"""What was observed in a study: plain values, the same whether the study's own journal or a table from elsewhere says.

A participant is a code here, never a name. What was not measured is None, or an empty text.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import msgspec


class Outcome(msgspec.Struct, frozen=True, kw_only=True):
    """One model that one participant was to adapt by one method.

    Attributes:
        participant: code.
        method: name.
        model: number, from 1.
        position: of the method in the participant's order, from 1.
        adapted: it was, within the attempts that the protocol allows.
        seconds: refinement time, while the operator was able to act [s]; None where it was not measured.
        refinements: attempts in all.
        updates: of the model.
        valid: false where the experimenter declared the attempt invalid: the robot's fault, an interruption.
        reason: why it is invalid.
    """

    participant: str
    method: str
    model: int
    position: int | None = None
    adapted: bool
    seconds: float | None = None
    refinements: int | None = None
    updates: int | None = None
    valid: bool = True
    reason: str = ""


class Rating(msgspec.Struct, frozen=True, kw_only=True):
    """What one participant said of one method.

    Attributes:
        participant: code.
        method: name.
        workload: weighted NASA-TLX, 0 to 100.
        raw_tlx: mean of its six scales, 0 to 100.
        sus: system usability scale, 0 to 100.
        trust: as the study's trust scale has it.
    """

    participant: str
    method: str
    workload: float | None = None
    raw_tlx: float | None = None
    sus: float | None = None
    trust: float | None = None


class Background(msgspec.Struct, frozen=True, kw_only=True):
    """Who a participant is; words as the form has them, or numbers.

    Attributes:
        participant: code.
        gender: in the participant's words, or the form's.
        age: in years, or a band.
        field: of study or work.
        gaming: experience, a code or a word.
        teleoperation: experience, a code or a word.
        handedness: right, left or both.
        group: sequence of methods that the participant was allocated to.
    """

    participant: str
    gender: str = ""
    age: str = ""
    field: str = ""
    gaming: str = ""
    teleoperation: str = ""
    handedness: str = ""
    group: str = ""


class Trial(msgspec.Struct, frozen=True, kw_only=True):
    """One attempt of one participant at one model by one method.

    Attributes:
        participant: code.
        method: name.
        model: number, from 1.
        number: of the attempt at that model, from 1.
        success: all criteria were met.
        seconds: that it took [s].
    """

    participant: str
    method: str
    model: int
    number: int
    success: bool
    seconds: float | None = None


class Training(msgspec.Struct, frozen=True, kw_only=True):
    """How one participant's training in one method ended.

    Attributes:
        participant: code.
        method: name.
        passed: the protocol's criterion was met in time.
        seconds: that it took [s].
    """

    participant: str
    method: str
    passed: bool
    seconds: float | None = None


class Observations(msgspec.Struct, frozen=True, kw_only=True):
    """All that was observed.

    Attributes:
        outcomes: one a participant, method and model.
        ratings: at most one a participant and method.
        backgrounds: at most one a participant.
        trials: where single attempts were kept.
        trainings: at most one a participant and method.
        synthetic: no person took part; marked in all that is made of it.
        source: where they are from, for the report.
        notes: about how they were read, for the report.
        words: what answers about the participants are called, in their order, by the background's name and the answer.
    """

    outcomes: tuple[Outcome, ...]
    ratings: tuple[Rating, ...] = ()
    backgrounds: tuple[Background, ...] = ()
    trials: tuple[Trial, ...] = ()
    trainings: tuple[Training, ...] = ()
    synthetic: bool = False
    source: str = ""
    notes: tuple[str, ...] = ()
    words: dict[str, dict[str, str]] = msgspec.field(default_factory=dict)

    def called(self, background: str, said: str) -> str:
        """An answer as people read it.

        Args:
            background: what about the participants, such as "gaming".
            said: as it was recorded.
        """
        return self.words.get(background, {}).get(said) or said.replace("_", " ")

    def levels(self, background: str, said: Iterable[str]) -> list[str]:
        """Answers once each, in the order in which they were offered; where that is not known as `in_order`.

        Args:
            background: what about the participants.
            said: as they were recorded.
        """
        offered, there = list(self.words.get(background, {})), in_order(said)
        return [one for one in offered if one in there] + [one for one in there if one not in offered]

    @property
    def participants(self) -> list[str]:
        """The codes of all, those that are numbers by their value."""
        rated = [one.participant for one in self.ratings] + [one.participant for one in self.trainings]
        said = [one.participant for one in self.backgrounds]
        return in_order([one.participant for one in self.outcomes] + rated + said)

    @property
    def methods(self) -> list[str]:
        """Those that anybody used, as they are first named."""
        return list(dict.fromkeys([one.method for one in self.outcomes] + [one.method for one in self.ratings]))

    @property
    def models(self) -> list[int]:
        """Their numbers."""
        return sorted({one.model for one in self.outcomes})

    def arranged(self, methods: Sequence[str]) -> Observations:
        """The same in one order, whatever the source's: these methods first, then the others, as do participants.

        Args:
            methods: names, of which some may not be there.
        """
        people = {name: i for i, name in enumerate(self.participants)}
        there = [one for one in methods if one in self.methods]
        used = {name: i for i, name in enumerate([*there, *sorted(set(self.methods) - set(there))])}
        return msgspec.structs.replace(
            self,
            outcomes=tuple(sorted(self.outcomes, key=lambda o: (used[o.method], people[o.participant], o.model))),
            ratings=tuple(sorted(self.ratings, key=lambda r: (used[r.method], people[r.participant]))),
            backgrounds=tuple(sorted(self.backgrounds, key=lambda b: people[b.participant])),
        )

    def order(self, participant: str) -> tuple[str, ...]:
        """The methods in the order that a participant met them; empty where that is not known."""
        met = {o.position: o.method for o in self.outcomes if o.participant == participant and o.position is not None}
        return tuple(met[position] for position in sorted(met))


def in_order(names: Iterable[str]) -> list[str]:
    """Names once each; numbers by their value, before words by their letters."""
    return sorted(set(names), key=lambda name: (not name.isdecimal(), int(name) if name.isdecimal() else 0, name))
