"""What the journal comes to: the values that are analysed. Derived, and made anew from the journal at any time."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from services.study.analysis.hypotheses import Measure
from services.study.analysis.observations import Background, Observations, Outcome, Rating, Training, Trial
from services.study.events import Answered, Entry
from services.study.instruments.instrument import Instrument
from services.study.instruments.questions import Choice, in_english
from services.study.protocol.protocol import Protocol
from services.study.session.course import Adapt, Participant, Train, course, participants

_BACKGROUND = ("gender", "age", "field", "gaming", "teleoperation", "handedness")

SCORES = {
    Measure.WORKLOAD: "workload",
    Measure.RAW_TLX: "raw_workload",
    Measure.SUS: "usability",
    Measure.TRUST: "trust",
}
"""Of a questionnaire, that a measure is."""


def code(number: int) -> str:
    """What a participant is called in data and figures."""
    return f"P{number:02}"


def observed(
    protocol: Protocol, entries: Iterable[Entry], instruments: Mapping[str, Instrument], source: str
) -> Observations:
    """All that was observed of those who took part and have not withdrawn.

    Args:
        protocol: of the study.
        entries: of its journal.
        instruments: that the protocol names.
        source: what the report says that it is from.
    """
    people = [one for _, one in sorted(participants(entries).items()) if one.gone != "withdrawn"]
    return Observations(
        outcomes=tuple(outcome for one in people for outcome in _outcomes(protocol, one)),
        ratings=tuple(rating for one in people for rating in _ratings(one, instruments)),
        backgrounds=tuple(_background(one) for one in people),
        trials=tuple(trial for one in people for trial in _trials(one)),
        trainings=tuple(training for one in people for training in _trainings(one)),
        synthetic=any(one.enrolled.synthetic for one in people),
        source=source,
        words=_words(instruments),
    )


def _words(instruments: Mapping[str, Instrument]) -> dict[str, dict[str, str]]:
    """What the answers about the participants are called."""
    return {
        question.name: {option.name: in_english(option.text) for option in question.options}
        for instrument in instruments.values()
        for question in instrument.questions
        if question.name in _BACKGROUND and isinstance(question, Choice)
    }


def _outcomes(protocol: Protocol, one: Participant) -> Iterable[Outcome]:
    """Of every model that was begun and ended."""
    for part in course(protocol, one.enrolled.order):
        ended = one.ended.get(part.name)
        if not isinstance(part, Adapt) or ended is None:
            continue
        attempts = one.attempts.get(part.name, [])
        why = one.invalid.get(part.name, "")
        yield Outcome(
            participant=code(one.number),
            method=part.method,
            model=part.model,
            position=one.enrolled.order.index(part.method) + 1,
            adapted=ended.passed,
            seconds=ended.seconds if ended.passed else None,
            refinements=sum(attempt.teaching is not None for attempt in attempts),
            updates=attempts[-1].updates if attempts else 0,
            valid=not why,
            reason=why,
        )


def _ratings(one: Participant, instruments: Mapping[str, Instrument]) -> Iterable[Rating]:
    """Of every method that was rated."""
    for method in one.enrolled.order:
        scores: dict[str, float] = {}
        for answered in one.answers.values():
            if answered.after == method:
                scores |= _scores(answered, instruments)
        if scores:
            yield Rating(
                participant=code(one.number),
                method=method,
                **{measure.value: scores.get(name) for measure, name in SCORES.items()},
            )


def _scores(answered: Answered, instruments: Mapping[str, Instrument]) -> dict[str, float]:
    instrument = instruments.get(answered.instrument)
    same = instrument is not None and instrument.version == answered.version
    return instrument.scored(answered.answers) if instrument is not None and same else {}


def _background(one: Participant) -> Background:
    said: dict[str, str] = {}
    for answered in one.answers.values():
        if not answered.after:
            said |= {name: str(answered.answers[name]) for name in _BACKGROUND if name in answered.answers}
    return Background(participant=code(one.number), group=str(one.enrolled.group + 1), **said)


def _trials(one: Participant) -> Iterable[Trial]:
    for name, attempts in one.attempts.items():
        method, _, model = name.partition("/")
        if model.isdecimal():
            for attempt in attempts:
                if attempt.teaching is not None:
                    yield Trial(
                        participant=code(one.number),
                        method=method,
                        model=int(model),
                        number=attempt.number,
                        success=attempt.success,
                        seconds=attempt.active,
                    )


def _trainings(one: Participant) -> Iterable[Training]:
    for method in one.enrolled.order:
        ended = one.ended.get(Train(method).name)
        if ended is not None:
            yield Training(participant=code(one.number), method=method, passed=ended.passed, seconds=ended.seconds)
