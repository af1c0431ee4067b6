"""The report's figures show every value whole, on axes that can be read, and call answers what people read."""

import msgspec
import numpy as np
import pytest

from services.reproduction.style import panels
from services.study.analysis.analysis import analysed
from services.study.analysis.effect_figures import backgrounds
from services.study.analysis.figures import from_zero, round_times
from services.study.analysis.hypotheses import Plan
from services.study.analysis.reporting import Reporting, appendix
from tests.services.study.analysis.studies import study

WORDS = {"gender": {"woman": "Woman"}, "gaming": {"ten_hours": "10 hours", "day": "1 day"}}


@pytest.mark.parametrize("values", [[20.5] * 5, [20.4, 20.5], [1.0, 1.0], [0.3, 55.0]])
@pytest.mark.parametrize("whole", [False, True])
def test_the_largest_value_is_below_the_upper_edge(values, whole):
    _, (pane,) = panels([""])
    pane.scatter(range(len(values)), values)
    from_zero(pane, whole=whole)
    assert pane.get_ylim()[0] == 0.0
    assert pane.get_ylim()[1] >= 1.05 * max(values)


@pytest.mark.parametrize("most", [1, 2, 3, 15, 54])
def test_counts_have_whole_ticks(most):
    _, (pane,) = panels([""])
    pane.bar([0], [most])
    from_zero(pane, whole=True)
    assert all(tick == round(tick) for tick in pane.get_yticks())


@pytest.mark.parametrize(("low", "high"), [(16.1, 58.0), (18.0, 18.0), (18.0, 20.0), (0.4, 90.0), (95.0, 130.0)])
def test_a_logarithmic_axis_has_several_round_ticks_within_it(low, high):
    ticks, labels = round_times(low, high)
    assert 3 <= len(ticks) <= 10
    assert all(low / 1.16 <= tick <= high * 1.16 for tick in ticks)
    assert [float(label) for label in labels] == pytest.approx(ticks)


@pytest.fixture
def told():
    """A study whose people said how much they play, by the form's codes."""
    observations = study(np.random.default_rng(2), people=8)
    said = ("day", "ten_hours")
    people = [msgspec.structs.replace(b, gaming=said[i % 2]) for i, b in enumerate(observations.backgrounds)]
    return msgspec.structs.replace(observations, backgrounds=tuple(people))


@pytest.mark.parametrize(("words", "called"), [(WORDS, ("10 hours", "1 day")), ({}, ("day", "ten hours"))])
def test_answers_are_called_what_was_read_and_stand_in_the_forms_order(told, words, called):
    observations = msgspec.structs.replace(told, words=words)
    analysis = analysed(observations, Plan())
    (gaming,) = [one.text for one in appendix(observations, analysis, Reporting()) if one.name == "Gaming experience"]
    assert gaming == f"{called[0]}: 4, {called[1]}: 4"
    image = backgrounds(observations, analysis)[0].image.decode()
    first, second = (image.index(f"<!-- {name} -->") for name in called)
    assert first < second
    assert "ten_hours" not in image
