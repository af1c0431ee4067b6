"""What in a questionnaire's file contradicts itself, or the protocol that names it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from services.study.instruments.instrument import Instrument
from services.study.instruments.questions import Choice, Number, Pairs, Question, Scale, Words
from services.study.instruments.scoring import Mean, Score, Weighted

FORMAT = 1
"""Of the file; another one is read by another version."""

Found = Iterator[tuple[str, str]]
"""Places, and what is wrong there."""


def contradictions(one: Instrument, stem: str, languages: Sequence[str], *, among: bool) -> Found:
    """All of them, the first first.

    Args:
        one: that was read.
        stem: of its file's name.
        languages: that the protocol wants.
        among: the protocol has given its methods.
    """
    if one.format != FORMAT:
        yield "format", f"this version reads format {FORMAT}, the file says {one.format}"
        return
    if one.name != stem:
        yield "name", f"it says {one.name}, the file is called {stem}.toml"
    if not one.questions:
        yield "questions", "there is none"
    names = [question.name for question in one.questions]
    yield from (("questions", f"{name} stands there twice") for name in _twice(names))
    wanted = tuple(dict.fromkeys((*one.title, *languages)))
    yield from _spoken("title", one.title, wanted)
    if one.instructions:
        yield from _spoken("instructions", one.instructions, wanted)
    scales = {question.name: question for question in one.questions if isinstance(question, Scale)}
    for question in one.questions:
        place = f"questions: {question.name}"
        for words in question.words:
            yield from _spoken(place, words, wanted)
        yield from ((place, reason) for reason in _of_question(question, scales, among=among))
    yield from _of_scores(one.scores, scales, {q.name: q for q in one.questions if isinstance(q, Pairs)})


def _spoken(place: str, words: Words, wanted: Sequence[str]) -> Found:
    yield from ((place, f"there is no text in {language}") for language in wanted if language not in words)


def _of_question(question: Question, scales: dict[str, Scale], *, among: bool) -> Iterator[str]:
    match question:
        case Scale(low=low, high=high, step=step):
            if high <= low or abs((high - low) / step - round((high - low) / step)) > 1e-9:
                yield f"from {low:g} to {high:g} there are no steps of {step:g}"
            elif (high - low) / step > 100:
                yield "it has more than 101 ticks"
        case Number(low=low, high=high):
            if high < low:
                yield f"nothing is between {low:g} and {high:g}"
        case Choice():
            yield from _of_choice(question, among=among)
        case Pairs(of=of):
            if len(set(of)) < 2 or len(set(of)) < len(of):
                yield "pairs want two scales at least, each once"
            yield from (f"{name} is no scale" for name in of if name not in scales)
        case _:
            pass


def _of_choice(choice: Choice, *, among: bool) -> Iterator[str]:
    if choice.among:
        if choice.options:
            yield "it has options of its own, and is among the methods"
        elif not among:
            yield "it is among a protocol's methods, and there is no protocol"
        return
    names = [option.name for option in choice.options]
    if len(names) < 2:
        yield "a choice wants two options at least"
    yield from (f"option {name} stands there twice" for name in _twice(names))


def _of_scores(scores: Sequence[Score], scales: dict[str, Scale], pairs: dict[str, Pairs]) -> Found:
    yield from (("scores", f"{name} stands there twice") for name in _twice([score.name for score in scores]))
    for score in scores:
        place = f"scores: {score.name}"
        if not score.of or len(set(score.of)) < len(score.of):
            yield place, "it wants one scale at least, each once"
        yield from ((place, f"{name} is no scale") for name in score.of if name not in scales)
        match score:
            case Mean(of=of, reversed=turned, range=span):
                yield from ((place, f"{name} is reversed, and not in it") for name in turned if name not in of)
                if span and (len(span) != 2 or span[1] <= span[0]):
                    yield place, "a range is a low and a high number: [0, 100]"
            case Weighted(pairs=name, of=of):
                optional = [one for one in of if one in scales and not scales[one].required]
                if name not in pairs:
                    yield place, f"{name} are no pairs"
                elif optional or not pairs[name].required:
                    yield place, f"{', '.join(optional) or name} may stay empty, and it wants all of them"
                elif set(pairs[name].of) != set(of):
                    yield place, f"the pairs of {name} are of other scales"


def _twice(names: Sequence[str]) -> list[str]:
    return sorted({name for name in names if names.count(name) > 1})
