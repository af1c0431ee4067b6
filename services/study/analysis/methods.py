"""The paragraph of a paper that says how the data were analysed, made of the plan and of what was found."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version

from services.study.analysis.analysis import Analysis
from services.study.analysis.effects import RESAMPLES
from services.study.analysis.hypotheses import Direction, Hypothesis, Measure
from services.study.analysis.rules import Unit, rules_of


def paragraph(analysis: Analysis) -> str:
    """Ready to be pasted, in the past tense."""
    plan, rules, flow = analysis.plan, rules_of(analysis.plan.rules), analysis.flow
    people = "synthetic participants (no person took part)" if analysis.synthetic else "participants"
    sentences = [
        f"{flow.participants} {people} were observed with {len(analysis.methods)} methods"
        f" ({', '.join(analysis.methods)}) and {len(analysis.models)} model{'s' * (len(analysis.models) > 1)} a"
        " method.",
        f"Refinement times are about participants who adapted every model and passed every training"
        f" ({flow.included} of {flow.participants}); workload is about all of them.",
    ]
    family = [one for one in plan.hypotheses if one.confirmatory]
    listed = "; ".join(_stated(one) for one in family)
    if rules.unit is Unit.PARTICIPANT:
        sentences += [
            "The unit of analysis is the participant: of each participant and method the median over models of the"
            " refinement time, and the one workload that was stated.",
            f"{_counted(family, listed)} tested within participants, on each participant's mean over"
            " the methods of either side, by Wilcoxon signed-rank tests: exact conditional on the observed"
            f" ranks (Streitberg and Röhmel 1986) up to {rules.exact_up_to} pairs, by the normal approximation with its"
            " correction for ties beyond; differences of zero were left out.",
            f"Their p-values were adjusted by Holm's method for a family-wise error rate of {analysis.alpha:g}."
            if len(family) > 1
            else f"The error rate was {analysis.alpha:g}.",
            "Effect sizes are matched-pairs rank-biserial correlations with"
            f" {_percent(plan.confidence)} percentile bootstrap intervals ({RESAMPLES} resamples of participants) and"
            f" Hodges-Lehmann shifts with exact {_percent(plan.confidence)} intervals.",
            "Each test was repeated without exclusions, and for refinement time with models that were not adapted"
            " ranked last (Lachin 1999).",
        ]
    else:
        sentences += [
            "By the rules of the thesis each model of each participant is one value, and a workload one for each"
            " model.",
            f"Hypotheses ({listed}) were tested by Wilcoxon signed-rank tests on the pooled pairs of methods, by the"
            f" normal approximation, at {analysis.alpha:g} each and without an adjustment.",
        ]
    ordered = any(check.test for check in analysis.checks)
    position = ", position in the order" if ordered else ""
    sentences.append(
        "Linear mixed models of the logarithm of the refinement time and of the workload had the participant as a"
        f" random intercept and method{position} and model (of the time) as fixed factors; they were"
        " estimated by restricted maximum likelihood, and tested with degrees of freedom within participants."
    )
    if ordered:
        sentences.append(
            "Carry-over was examined by Kruskal-Wallis tests of the sequences' totals, by Mann-Whitney tests between"
            " who began with either side, and by the method before as a factor of the mixed model; no analysis was"
            " chosen by them (Freeman 1989)."
        )
    sentences += [
        "Effects of participants' backgrounds are exploratory and not adjusted.",
        f"Resampling was seeded ({plan.seed}). {_software()}.",
    ]
    return " ".join(sentences)


def _counted(family: Sequence[Hypothesis], listed: str) -> str:
    if len(family) == 1:
        return f"One confirmatory hypothesis ({listed}) was"
    return f"{len(family)} confirmatory hypotheses ({listed}) were"


def _stated(hypothesis: Hypothesis) -> str:
    first, second = hypothesis.sides
    what = "refinement time" if hypothesis.measure is Measure.SECONDS else hypothesis.measure.title
    tail = "two-sided" if hypothesis.direction is Direction.DIFFERENT else "one-sided"
    return f"{what}, {first} {hypothesis.direction.sign} {second}, {tail}"


def _percent(confidence: float) -> str:
    return f"{100.0 * confidence:g} %"


def _software() -> str:
    return f"Analysed with {software()}"


def software() -> str:
    """What it was analysed with, with versions."""
    try:
        ours = version("retouch")
    except PackageNotFoundError:
        ours = "of this folder"
    return f"Retouch {ours}, Python {platform.python_version()}, NumPy {version('numpy')}, SciPy {version('scipy')}"
