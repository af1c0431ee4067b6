"""What readers and ethics boards ask of every study with people, and most papers leave out.

The items are those that a review of 236 studies of human-robot interaction found missing most (arXiv 2201.09114), in
the form of the reporting appendix that was asked for since (doi 10.1145/3568294.3580162).
"""

from __future__ import annotations

from collections import Counter
from statistics import median

import msgspec

from services.study.analysis.analysis import Analysis
from services.study.analysis.exclusion import Sample
from services.study.analysis.hypotheses import Measure
from services.study.analysis.numerals import figure
from services.study.analysis.observations import Observations
from services.study.analysis.rules import RETOUCH
from services.study.analysis.sensitivity import sensitivity

NOT_GIVEN = "not given"


class Reporting(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What only the study's protocol knows; a table of outcomes does not.

    Attributes:
        title: of the study.
        recruitment: how participants were found, and who could take part.
        compensation: what they got.
        consent: how they gave it.
        ethics: who approved the study, and under which number.
        place: where it was.
        dates: when.
        sample_size: why so many people, with the power that they give.
        exclusion: the rules, in words, and when they were fixed.
        preregistration: where, and the digest of the frozen protocol.
        deviations: from it.
        instruments: questionnaires, with version and language.
        system: robot or simulation, devices and software.
    """

    title: str = ""
    recruitment: str = ""
    compensation: str = ""
    consent: str = ""
    ethics: str = ""
    place: str = ""
    dates: str = ""
    sample_size: str = ""
    exclusion: str = ""
    preregistration: str = ""
    deviations: tuple[str, ...] = ()
    instruments: tuple[str, ...] = ()
    system: str = ""


class Item(msgspec.Struct, frozen=True):
    """A line of the appendix.

    Attributes:
        name: what is reported.
        text: what there is to report, or `NOT_GIVEN`.
    """

    name: str
    text: str

    @property
    def given(self) -> bool:
        """There is something to report."""
        return not self.text.startswith(NOT_GIVEN)


def appendix(observations: Observations, analysis: Analysis, reporting: Reporting) -> tuple[Item, ...]:
    """The reporting appendix, in the order in which papers have it."""
    flow = analysis.flow
    excluded = f"{len(flow.excluded)} of {flow.participants} from the refinement time, nobody from the workload"
    # By the frozen rules and no others: what was found is not a reason to leave anybody out.
    invalid = sum(cell.invalid for cell in flow.cells)
    items = [
        ("Participants", f"{flow.participants}{', all synthetic: no person took part' if analysis.synthetic else ''}"),
        ("Recruitment", reporting.recruitment),
        ("Compensation", reporting.compensation),
        ("Consent", reporting.consent),
        ("Ethics approval", reporting.ethics),
        ("Gender", _counted(observations, "gender")),
        ("Age", _aged(observations)),
        ("Handedness", _counted(observations, "handedness")),
        ("Field of study or work", _counted(observations, "field")),
        ("Gaming experience", _counted(observations, "gaming")),
        ("Teleoperation experience", _counted(observations, "teleoperation")),
        ("Sample size and power", reporting.sample_size),
        ("Sensitivity", _sensitivity(analysis)),
        ("Rules of exclusion", reporting.exclusion or f"refinement time: {Sample.PLANNED.meaning(Measure.SECONDS)}"),
        ("Excluded", excluded),
        ("Declared invalid", f"{invalid} of {sum(cell.models for cell in flow.cells)} models"),
        ("Order of methods", _orders(observations)),
        ("Preregistration", reporting.preregistration),
        ("Deviations from it", "; ".join(reporting.deviations) or ("none" if reporting.preregistration else "")),
        ("Instruments", "; ".join(reporting.instruments)),
        ("Robot, devices, software", reporting.system),
        ("Place and time", ", ".join(one for one in (reporting.place, reporting.dates) if one)),
    ]
    return tuple(Item(name, text or NOT_GIVEN) for name, text in items)


def _sensitivity(analysis: Analysis) -> str:
    if analysis.plan.rules != RETOUCH.name:
        return ""
    decided = [one for one in analysis.results if one.sample is Sample.PLANNED and one.hypothesis.confirmatory]
    return sensitivity(decided, analysis.alpha)


def _counted(observations: Observations, name: str) -> str:
    """How many said what."""
    said = Counter(str(getattr(one, name)) or NOT_GIVEN for one in observations.backgrounds)
    if not set(said) - {NOT_GIVEN}:
        return ""
    known = observations.levels(name, set(said) - {NOT_GIVEN})
    last = [NOT_GIVEN] if NOT_GIVEN in said else []
    return ", ".join(f"{observations.called(name, text)}: {said[text]}" for text in (*known, *last))


def _aged(observations: Observations) -> str:
    """Median and range where ages are years, else how many are in each band."""
    people = observations.backgrounds
    years = [float(one.age) for one in people if one.age.replace(".", "", 1).isdecimal()]
    if not years or len(years) < sum(bool(one.age) for one in people):
        return _counted(observations, "age")
    missing = len(people) - len(years)
    said = f"median {figure(median(years), 0)}, {figure(min(years), 0)} to {figure(max(years), 0)} years"
    return said + (f", {missing} {NOT_GIVEN}" if missing else "")


def _orders(observations: Observations) -> str:
    """How many participants met the methods in each order."""
    orders = Counter(" – ".join(observations.order(one)) for one in observations.participants)
    del orders[""]
    return ", ".join(f"{order}: {count}" for order, count in sorted(orders.items()))
