"""All that a study's observations come to, in numbers."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from services.study.analysis.backgrounds import Influence, influences
from services.study.analysis.carry_over import Check, carry_over
from services.study.analysis.comparison import Result, compared
from services.study.analysis.exceptions import NothingToAnalyse
from services.study.analysis.exclusion import Flow, Sample, flow_of
from services.study.analysis.hypotheses import Measure, Plan
from services.study.analysis.learning import Attempts, Course, attempts, courses
from services.study.analysis.mixed import MixedModel, fitted
from services.study.analysis.observations import Observations
from services.study.analysis.rules import RETOUCH, THESIS, rules_of
from services.study.analysis.summary import Summary, summaries, taken
from services.study.analysis.thesis import ThesisTables, thesis_tables

_EXPLAINED = (Measure.SECONDS, Measure.WORKLOAD)

Progress = Callable[[float], None]
"""Called with the share of the work that is done, from 0 to 1."""


class Analysis(msgspec.Struct, frozen=True):
    """What a study found; as JSON it is all the numbers of its report.

    Attributes:
        source: of the observations.
        synthetic: no person took part.
        notes: about how they were read.
        plan: by which they were analysed.
        alpha: error rate that was used.
        criticism: what is wrong with the plan's rules; empty of ours.
        methods: in the report's order.
        models: their numbers.
        flow: what became of the participants.
        summaries: medians and quartiles.
        results: the hypotheses, tested.
        models_fitted: mixed models of time and workload, by the rules and without exclusions.
        checks: of the methods' order.
        courses: times from model to model and from method to method.
        attempts: how single attempts ended.
        influences: of who takes part.
        thesis: its further tables, by its rules.
        ours: by its rules: the hypotheses once more, with the participant as the unit.
    """

    source: str
    synthetic: bool
    notes: tuple[str, ...]
    plan: Plan
    alpha: float
    criticism: tuple[str, ...]
    methods: tuple[str, ...]
    models: tuple[int, ...]
    flow: Flow
    summaries: tuple[Summary, ...]
    results: tuple[Result, ...]
    models_fitted: tuple[MixedModel, ...]
    checks: tuple[Check, ...]
    courses: tuple[Course, ...]
    attempts: tuple[Attempts, ...]
    influences: tuple[Influence, ...]
    thesis: ThesisTables | None
    ours: tuple[Result, ...]


def analysed(observations: Observations, plan: Plan, progress: Progress = lambda _: None) -> Analysis:
    """Analyse a study.

    The order of the observations is no matter: every figure is the same to its last digit.

    Args:
        observations: of the study.
        plan: that was fixed before it.
        progress: is told how it goes on.

    Raises:
        NothingToAnalyse: no measure was taken of anybody.
        UnknownMethod: a hypothesis is about a method that nobody used.
        AnalysisError: there are no such rules, or they cannot test a hypothesis.
    """
    rules = rules_of(plan.rules)
    observations = observations.arranged(plan.methods)
    measures = [one for one in taken(observations) if one in _EXPLAINED]
    if not measures:
        raise NothingToAnalyse(f"{observations.source or 'the study'} holds neither a refinement time nor a workload")
    results = compared(observations, plan)
    progress(0.3)
    samples = [(m, s) for m in measures for s in (Sample.PLANNED, Sample.SUCCEEDED if m.rated else Sample.ALL)]
    models = tuple(fitted(observations, measure, sample, plan.confidence) for measure, sample in samples)
    progress(0.5)
    checks = carry_over(observations, plan, measures)
    progress(0.7)
    explained = influences(observations, plan, measures)
    progress(0.9)
    found = Analysis(
        source=observations.source,
        synthetic=observations.synthetic,
        notes=observations.notes,
        plan=plan,
        alpha=plan.alpha or rules.alpha,
        criticism=rules.criticism,
        methods=tuple(observations.methods),
        models=tuple(observations.models),
        flow=flow_of(observations),
        summaries=summaries(observations, rules),
        results=results,
        models_fitted=models,
        checks=checks,
        courses=courses(observations),
        attempts=attempts(observations),
        influences=explained,
        thesis=thesis_tables(observations) if rules is THESIS else None,
        ours=_ours(observations, plan) if rules is THESIS else (),
    )
    progress(1.0)
    return found


def _ours(observations: Observations, plan: Plan) -> tuple[Result, ...]:
    found = compared(observations, msgspec.structs.replace(plan, rules=RETOUCH.name, alpha=None))
    return tuple(one for one in found if one.sample is Sample.PLANNED)
