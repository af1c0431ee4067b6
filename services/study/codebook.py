"""A data set's codebook: what each column means, and each question and answer of the questionnaires."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from services.study.instruments.instrument import Instrument
from services.study.instruments.questions import Choice, Number, Option, Pairs, Question, Scale, in_english

MEANINGS = {
    "participant": "code of the participant; no name",
    "method": "by its name in the protocol",
    "model": "number of the model that was adapted, from 1",
    "position": "of the method in the participant's order, from 1",
    "adapted": "the robot alone succeeded within what is allowed",
    "seconds": "time in which the operator could act, until the model was adapted [s]",
    "refinements": "attempts that the operator led",
    "updates": "of the model",
    "valid": "the experimenter did not declare it invalid",
    "reason": "why not",
    "part": "of the session: METHOD/MODEL or METHOD/training",
    "number": "of the attempt in its part, from 1",
    "teaching": "how the operator led; empty where the robot moved alone",
    "success": "reached, nothing kicked over, no collision",
    "reached": "the target",
    "kicked_over": "something was",
    "collision": "with something",
    "active": "time in which the operator could act [s]",
    "began": "since the part's begin [s]",
    "ended": "since the part's begin [s]",
    "void": "why the attempt does not count; empty where it does",
    "recording": "file of the run; not in this data set",
    "why": "what ended an attempt that came to no end, and was made again",
    "acting": "time in which the operator could act, of an attempt that came to no end [s]",
    "holding": "the same in which the robot held [s]",
    "alone": "the same in which it moved alone [s]",
    "other": "the rest of the time since the attempt before [s]",
    "gender": "as the participant said",
    "age": "band, as the participant said",
    "field": "of study or work, as the participant said",
    "gaming": "experience, as the participant said",
    "teleoperation": "experience, as the participant said",
    "handedness": "as the participant said",
    "group": "number of the order of methods, from 1",
    "workload": "NASA-TLX, weighted, 0 to 100",
    "raw_tlx": "NASA-TLX, mean of the six scales, 0 to 100",
    "sus": "system usability scale, 0 to 100",
    "trust": "as its questionnaire has it",
    "instrument": "name of the questionnaire",
    "after": "the method that it is about; empty for none",
    "question": "by its name in the questionnaire",
    "place": "of the question in the order in which it was shown, from 1",
    "answer": "as it was given",
    "synthetic": "true: no person took part, the participant is simulated",
}


def variables(columns: Sequence[str], instruments: Mapping[str, Instrument]) -> list[dict[str, object]]:
    """Every column as schema.org has it, with the levels of what is one of several answers.

    Args:
        columns: by their names.
        instruments: that were asked, by their names.
    """
    return [
        {
            "@type": "PropertyValue",
            "name": column,
            "description": MEANINGS[column],
            **({"valueReference": levels} if (levels := [_term(one) for one in _options(column, instruments)]) else {}),
        }
        for column in columns
    ]


def columns(names: Sequence[str], instruments: Mapping[str, Instrument]) -> list[str]:
    """The same of a table, as lines of Markdown.

    Args:
        names: of the columns.
        instruments: that were asked, by their names.
    """
    return [
        line
        for name in names
        for line in (f"- `{name}`: {MEANINGS[name]}", *(_level(one) for one in _options(name, instruments)))
    ]


def questions(instrument: Instrument) -> list[str]:
    """A questionnaire's questions and what their answers mean, as lines of Markdown."""
    title = f"### Questionnaire `{instrument.name}`, version {instrument.version}: {in_english(instrument.title)}"
    return [title, "", *(line for question in instrument.questions for line in _question(question))]


def _question(question: Question) -> list[str]:
    text, about = (" ".join(in_english(words).split()) for words in (question.text, question.about))
    between = " " if text.endswith((".", "?", "!")) else ": "
    return [f"- `{question.name}`: {text}{between + about if about else ''}", *_answers(question)]


def _answers(question: Question) -> list[str]:
    match question:
        case Scale(low=low, high=high, left=left, right=right):
            return [f"  - {low:g}: {in_english(left)}; {high:g}: {in_english(right)}"]
        case Choice(options=options):
            return [_level(one) for one in options]
        case Number(low=low, high=high):
            return [f"  - a number from {low:g} to {high:g}"]
        case Pairs(of=of):
            return [f"  - of every two of {', '.join(of)}: the name of the one that was chosen"]
        case _:
            return ["  - in the participant's words"]


def _options(column: str, instruments: Mapping[str, Instrument]) -> list[Option]:
    """Of the question that a column is about; none where there is none."""
    asked = [question for one in instruments.values() for question in one.questions if question.name == column]
    return [option for question in asked[:1] if isinstance(question, Choice) for option in question.options]


def _level(option: Option) -> str:
    return f"  - `{option.name}`: {in_english(option.text)}"


def _term(option: Option) -> dict[str, str]:
    return {"@type": "DefinedTerm", "termCode": option.name, "name": in_english(option.text)}
