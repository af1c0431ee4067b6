"""A preregistration's text, from the protocol: what an ethics board and a registry ask, in their order."""

from __future__ import annotations

from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Direction, Hypothesis, Measure
from services.study.analysis.rules import rules_of
from services.study.freezing import Frozen
from services.study.instruments.questions import in_english
from services.study.protocol.orders import Allocation, orders
from services.study.protocol.protocol import Protocol

FILE = "preregistration.md"


def text(protocol: Protocol, frozen: Frozen) -> str:
    """The whole of it, in Markdown."""
    return "\n".join(
        [
            f"# {protocol.title}",
            "",
            f"Protocol `{protocol.name}`, version {protocol.version}, frozen at {frozen.at} (UTC).",
            "",
            "## Hypotheses",
            "",
            *(_hypothesis(one) for one in protocol.analysis.hypotheses),
            "",
            "## Design",
            "",
            *_design(protocol),
            "",
            "## Sample",
            "",
            f"{protocol.order.participants} participants. {_whole(protocol.recruitment.inclusion)}",
            f"Recruitment: {_whole(protocol.recruitment.how)}",
            f"Compensation: {_whole(protocol.recruitment.compensation)}",
            f"Ethics: {_whole(protocol.recruitment.ethics)}",
            "",
            "## Measures",
            "",
            "`seconds`: time in which the operator could act, until a model was adapted; replay, reset and settling do",
            "not count, for any method. `refinements` and `updates`: how many it took.",
            f"Questionnaires: {', '.join(protocol.instruments.all)}.",
            "",
            "## Exclusions",
            "",
            *_exclusions(),
            "",
            "## Analysis",
            "",
            f"By the rules `{protocol.analysis.rules}`, at a level of"
            f" {protocol.analysis.alpha or rules_of(protocol.analysis.rules).alpha:g} for the family of confirmatory"
            " hypotheses, with intervals of"
            f" {protocol.analysis.confidence:.0%}.",
            "",
            "## Digests",
            "",
            *(f"- {name}: `{value}`" for name, value in frozen.files.items()),
            f"- the analysis: `{frozen.analysis}`",
            f"- software: {', '.join(f'{name} {version}' for name, version in frozen.software.items())}",
            "",
        ]
    )


def _hypothesis(one: Hypothesis) -> str:
    first, second = " and ".join(one.first), " and ".join(one.second)
    match one.direction:
        case Direction.DIFFERENT:
            said = f"{one.measure.title} differs between {first} and {second}"
        case Direction.LESS | Direction.GREATER:
            said = f"{one.measure.title} is {one.direction.value} with {first} than with {second}"
    shift = f"{one.smallest:g} {one.measure.unit}".rstrip() if one.smallest else ""
    smallest = f"; the smallest effect of interest is {shift}" if shift else ""
    return f"- {one.name}: {said} ({'confirmatory' if one.confirmatory else 'exploratory'}{smallest})."


def _design(protocol: Protocol) -> list[str]:
    task, training = protocol.task, protocol.training
    rows = orders(protocol.order, [method.name for method in protocol.methods])
    allocation = Allocation(protocol.order, len(rows))
    models = f"{task.models} identical models are" if task.models > 1 else "one model is"
    return [
        "Within participants: each does all methods, in one of these orders.",
        "",
        *(f"{number}. {', '.join(row)}" for number, row in enumerate(rows, 1)),
        "",
        f"Allocated in shuffled blocks (seed {protocol.order.seed}):"
        f" {', '.join(str(group + 1) for group in allocation.table())}.",
        "Who drops out is replaced by somebody with the same order."
        if protocol.order.replace
        else "Who drops out is not replaced.",
        "",
        *(
            f"- {method.name}: {method.teaching.value}, {method.device.value}. {in_english(method.about)}".rstrip()
            for method in protocol.methods
        ),
        "",
        f"With each method {models} adapted, with at most {_counted(task.updates, 'update')} each and"
        f" {_counted(task.refinements, 'attempt')} at an update.",
        f"Before each method: training until {training.successes} of the last {training.of_last} attempts succeeded,"
        f" {_counted(training.minutes, 'minute')} at most.",
    ]


def _exclusions() -> list[str]:
    """The rules in words, and what is reported beside them."""
    return [
        f"What is measured ({_measures(rated=False)}): {Sample.PLANNED.meaning(Measure.SECONDS)}.",
        f"What is rated ({_measures(rated=True)}): {Sample.PLANNED.meaning(Measure.WORKLOAD)}.",
        "",
        "Reported beside these results:",
        "",
        *(f"- {one.value}: {one.meaning(Measure.SECONDS)}." for one in Sample if one is not Sample.PLANNED),
    ]


def _measures(*, rated: bool) -> str:
    return ", ".join(f"`{one.value}`" for one in Measure if one.rated is rated)


def _counted(number: float, what: str) -> str:
    return f"{number:g} {what}{'s' * (number != 1)}"


def _whole(text: str) -> str:
    """A sentence, with its end."""
    stripped = text.strip()
    return stripped if stripped.endswith((".", "!", "?")) else f"{stripped}."
