"""A session's parts as the pages name them: what the browser makes words of."""

from __future__ import annotations

import msgspec

from services.study.instruments.questions import Words
from services.study.page.desk import Desk
from services.study.session.course import Adapt, Agree, Fill, Part, Rest, Train


class PartView(msgspec.Struct, frozen=True):
    """One of them.

    Attributes:
        name: of the part.
        kind: "consent", "form", "training", "model" or "rest".
        method: with which, or about which; empty for none.
        model: number, from 1; 0 for none.
        models: how many there are with each method.
        title: of a form, by language.
    """

    name: str
    kind: str
    method: str = ""
    model: int = 0
    models: int = 0
    title: Words = msgspec.field(default_factory=dict)


def part_view(desk: Desk, part: Part) -> PartView:
    """A part as it is shown."""
    match part:
        case Agree():
            return PartView(part.name, "consent")
        case Fill(instrument=instrument, after=after):
            return PartView(part.name, "form", after, title=desk.instruments[instrument].title)
        case Train(method=method):
            return PartView(part.name, "training", method)
        case Adapt(method=method, model=model):
            return PartView(part.name, "model", method, model, desk.conductor.protocol.task.models)
        case Rest(after=after):
            return PartView(part.name, "rest", after)
