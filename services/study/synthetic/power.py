"""How often a study of so many people would show an effect of such a size, by its own analysis.

Each hypothesis is simulated where it alone holds. With an effect of nothing the figure is the error rate.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np

from services.offline.cluster import each_at
from services.offline.pool import Progress, each, overall
from services.offline.proportion import Proportion
from services.study.analysis.comparison import confirmatory
from services.study.analysis.hypotheses import Plan
from services.study.analysis.rules import rules_of
from services.study.protocol.orders import orders
from services.study.protocol.protocol import Protocol
from services.study.synthetic.population import Drawing, Population, drawn

AT_ONCE = 50
"""Studies of one piece of work."""


@dataclass(frozen=True)
class Cell:
    """Studies that are drawn alike.

    Attributes:
        people: who take part in each.
        effect: share by which one side of the hypothesis is better.
        hypothesis: its name.
    """

    people: int
    effect: float
    hypothesis: str


@dataclass(frozen=True)
class _Piece:
    """Some of them."""

    cell: Cell
    drawing: Drawing
    plan: Plan
    studies: int
    seed: tuple[int, ...]


@dataclass(frozen=True)
class Question:
    """What is asked of a protocol.

    Attributes:
        protocol: with methods, orders, hypotheses and rules.
        people: numbers of people to try.
        effects: sizes to try.
        studies: of each.
        seed: of all of them.
        population: of the people.
    """

    protocol: Protocol
    people: Sequence[int]
    effects: Sequence[float]
    studies: int = 500
    seed: int = 0
    population: Population = field(default_factory=Population)


def power(
    question: Question, jobs: int = 1, progress: Progress = lambda _: None, cluster: str = ""
) -> dict[Cell, Proportion]:
    """How many of the studies show each confirmatory hypothesis.

    Args:
        question: what is asked.
        jobs: processes at most.
        progress: is told how it goes on.
        cluster: address of a cluster's scheduler, which does the work instead; empty for this machine.

    Raises:
        CommandFailed: the cluster cannot do it.
    """
    pieces = list(_pieces(question))
    advance = overall(len(pieces), progress)
    done = each_at(cluster, _shown, pieces, advance) if cluster else each(_shown, pieces, jobs, advance)
    found: dict[Cell, list[int]] = {}
    for number, shown in done:
        found.setdefault(pieces[number].cell, []).append(shown)
    cells = dict.fromkeys(piece.cell for piece in pieces)
    return {cell: Proportion(sum(found[cell]), question.studies) for cell in cells}


def _pieces(question: Question) -> Iterator[_Piece]:
    protocol = question.protocol
    rows = orders(protocol.order, [method.name for method in protocol.methods])
    hypotheses = [one for one in protocol.analysis.hypotheses if one.confirmatory]
    for (index, about), people, effect in product(enumerate(hypotheses), question.people, question.effects):
        drawing = Drawing(rows, people, protocol.task.models, effect, about, question.population)
        for first in range(0, question.studies, AT_ONCE):
            at_once = min(AT_ONCE, question.studies - first)
            seed = (question.seed, index, people, round(1e6 * effect), first)
            yield _Piece(Cell(people, effect, about.name), drawing, protocol.plan, at_once, seed)


def _shown(piece: _Piece, progress: Progress) -> int:
    """How many of the studies reject the null hypothesis."""
    rng = np.random.default_rng(piece.seed)
    alpha = piece.plan.alpha or rules_of(piece.plan.rules).alpha
    shown = 0
    for number in range(piece.studies):
        p = confirmatory(drawn(piece.drawing, rng), piece.plan)[piece.cell.hypothesis]
        shown += p is not None and p <= alpha
        progress((number + 1) / piece.studies)
    return shown
