"""The protocol: one TOML file that says who does what in which order, what is asked, and how it will be analysed."""

from __future__ import annotations

import enum
import hashlib
from pathlib import Path
from typing import Annotated

import msgspec

from services.offline.people.ways import Device, Teaching
from services.process.section import Positive, Section
from services.process.written import read
from services.study.analysis.hypotheses import Plan
from services.study.analysis.rules import NAMES as RULES
from services.study.exceptions import ProtocolUnfit

FORMAT = 1
"""Of the file; another one is read by another version."""

FILE = "protocol.toml"

Count = Annotated[int, msgspec.Meta(ge=1, le=1000)]
Name = Annotated[str, msgspec.Meta(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,30}$")]
Text = Annotated[str, msgspec.Meta(min_length=1, max_length=4000)]


class Method(Section, frozen=True):
    """One of the ways that are compared.

    Attributes:
        name: short, as tables and figures have it.
        teaching: how it teaches.
        device: by which.
        about: one sentence that the participant is shown, by language; empty for none.
    """

    name: Name
    teaching: Teaching
    device: Device
    about: dict[str, Text] = msgspec.field(default_factory=dict)


class Task(Section, frozen=True):
    """What is taught.

    Attributes:
        scene: by its name.
        variant: of the scene, other than the model was trained in; empty for the last one.
        object_position: of the object's centre, base frame [m]; empty for the scene's own.
        models: identical initial models that are adapted with each method.
        updates: of one model at most.
        refinements: at one update at most.
    """

    scene: Text = "dishwasher"
    variant: str = ""
    object_position: tuple[float, ...] = ()
    models: Count = 3
    updates: Count = 8
    refinements: Count = 10


class Training(Section, frozen=True):
    """Before each method: attempts until some of the last ones succeeded.

    Attributes:
        successes: that end it.
        of_last: among so many of the last attempts.
        minutes: after which it has failed.
        attempts: after which it has failed.
    """

    successes: Count = 2
    of_last: Count = 4
    minutes: Positive = 30.0
    attempts: Count = 40


class Design(enum.Enum):
    """How the methods' orders are made.

    WILLIAMS: each method follows each other equally often (E. J. Williams, Australian J. Sci. Res. A 2, 1949).
    TABLE: as the file has them.
    """

    WILLIAMS = "williams"
    TABLE = "table"


class Order(Section, frozen=True):
    """Who does the methods in which order.

    Attributes:
        design: of the orders.
        table: of them, each a list of methods' names; for `TABLE`.
        participants: that are aimed at.
        seed: of the allocation, in blocks of all orders.
        replace: who drops out or fails is replaced by somebody with the same order.
    """

    design: Design = Design.WILLIAMS
    table: tuple[tuple[Name, ...], ...] = ()
    participants: Count = 18
    seed: int = 0
    replace: bool = True


class Instruments(Section, frozen=True):
    """Which questionnaires are asked when, by their names.

    Attributes:
        before: once, before the first method.
        after_method: after each method.
        after: once, at the end.
    """

    before: tuple[Name, ...] = ("participant",)
    after_method: tuple[Name, ...] = ("nasa_tlx",)
    after: tuple[Name, ...] = ()

    @property
    def all(self) -> tuple[str, ...]:
        """Each once, in the order in which they come."""
        return tuple(dict.fromkeys((*self.before, *self.after_method, *self.after)))


class Breaks(Section, frozen=True):
    """Between two methods, at least [min]."""

    minutes: Annotated[float, msgspec.Meta(ge=0.0, le=120.0)] = 5.0


class Resume(Section, frozen=True):
    """After a crash: how old the last checkpoint may be to go on from it without the experimenter's decision [min]."""

    minutes: Positive = 15.0


class Consent(Section, frozen=True):
    """What a participant agrees to.

    Attributes:
        version: of the text.
        text: by language.
    """

    version: Text
    text: dict[str, Text]

    def digest(self, language: str) -> str:
        """Of the text of a language, as it is written down that somebody has agreed to it."""
        return hashlib.sha256(self.text[language].strip().encode()).hexdigest()


class Recruitment(Section, frozen=True):
    """What an ethics board and a reviewer ask first; all of it is to be given.

    Attributes:
        how: people are found.
        inclusion: who may take part.
        compensation: what they get for it.
        ethics: which board approved it, and its number; or why none had to.
        contact: who answers for the data.
    """

    how: Text
    inclusion: Text
    compensation: Text
    ethics: Text
    contact: Text


class Protocol(Section, frozen=True):
    """The whole of it."""

    format: int
    name: Name
    version: Text
    title: Text
    languages: tuple[str, ...]
    recruitment: Recruitment
    consent: Consent
    methods: tuple[Method, ...]
    task: Task = msgspec.field(default_factory=Task)
    training: Training = msgspec.field(default_factory=Training)
    order: Order = msgspec.field(default_factory=Order)
    instruments: Instruments = msgspec.field(default_factory=Instruments)
    breaks: Breaks = msgspec.field(default_factory=Breaks)
    resume: Resume = msgspec.field(default_factory=Resume)
    analysis: Plan = msgspec.field(default_factory=lambda: Plan(hypotheses=()))

    @property
    def plan(self) -> Plan:
        """Of the analysis, with the methods in the protocol's order."""
        return msgspec.structs.replace(self.analysis, methods=tuple(method.name for method in self.methods))

    def method(self, name: str) -> Method:
        """The method of that name, which there is."""
        return next(method for method in self.methods if method.name == name)


def load(path: Path) -> Protocol:
    """A protocol that agrees with itself.

    Raises:
        ConfigurationError: it cannot be read, or has a wrong key, type or value.
        ProtocolUnfit: two of its parts contradict each other.
    """
    protocol = read(path, Protocol, "protocol")
    for place, reason in _contradictions(protocol):
        raise ProtocolUnfit(path, place, reason)
    return protocol


def _contradictions(protocol: Protocol) -> list[tuple[str, str]]:
    """Places, and what is wrong there."""
    if protocol.format != FORMAT:
        return [("format", f"this version reads format {FORMAT}, the file says {protocol.format}")]
    names = [method.name for method in protocol.methods]
    found = []
    if len(names) < 2:
        found.append(("methods", "a comparison wants two at least"))
    found += [("methods", f"{name} stands there twice") for name in sorted({n for n in names if names.count(n) > 1})]
    if not protocol.languages:
        found.append(("languages", "name one at least"))
    found += [
        ("consent.text", f"there is none in {language}")
        for language in protocol.languages
        if language not in protocol.consent.text
    ]
    found += [
        (f"methods: {method.name}", f"there is no explanation in {language}")
        for method in protocol.methods
        for language in protocol.languages
        if method.about and language not in method.about
    ]
    found += _of_order(protocol.order, names)
    found += _of_analysis(protocol.analysis, names)
    if protocol.training.successes > protocol.training.of_last:
        found.append(("training", f"{protocol.training.successes} of the last {protocol.training.of_last} cannot be"))
    return found


def _of_analysis(plan: Plan, names: list[str]) -> list[tuple[str, str]]:
    found = [] if plan.rules in RULES else [("[analysis] rules", f"there are {', '.join(RULES)}, not {plan.rules}")]
    for one in plan.hypotheses:
        place = f"[[analysis.hypotheses]] {one.name}"
        found += [(place, f"no method is called {name}") for name in (*one.first, *one.second) if name not in names]
        if set(one.first) & set(one.second) or not one.first or not one.second:
            found.append((place, "it wants methods on both sides, none of them on both"))
    return found


def _of_order(order: Order, names: list[str]) -> list[tuple[str, str]]:
    if order.design is Design.WILLIAMS:
        return [("order.table", 'it is for design = "table"')] if order.table else []
    if not order.table:
        return [("order.table", "the design is a table, and there is none")]
    return [
        (f"order.table, row {number}", f"it has to name each of {', '.join(names)} once")
        for number, row in enumerate(order.table, 1)
        if sorted(row) != sorted(names)
    ]
