"""Questionnaires take what is complete and allowed, and nothing else; what a file makes of answers is right."""

import random
from itertools import combinations

import numpy as np
import pytest

from services.process.exceptions import ConfigurationError
from services.study.exceptions import AnswerRefused, ProtocolUnfit
from services.study.instruments import SHIPPED
from services.study.instruments.instrument import shown_order
from services.study.instruments.library import load, of_protocol
from services.study.instruments.questions import Scale
from services.study.protocol.protocol import load as load_protocol
from services.study.protocols import SHIPPED as PROTOCOLS

SOURCES = ("mental", "physical", "temporal", "performance", "effort", "frustration")


@pytest.fixture(scope="module")
def protocol():
    return load_protocol(PROTOCOLS["thesis"])


@pytest.fixture
def tlx():
    return load(None, "nasa_tlx")


def tlx_answers(ratings, chosen):
    """Ratings by source, and of each pair the one that `chosen` picks."""
    pairs = {f"{one}/{other}": chosen(one, other) for one, other in combinations(SOURCES, 2)}
    return {**dict(zip(SOURCES, ratings, strict=True)), **pairs}


def first(one, other):
    del other
    return one


@pytest.mark.parametrize("name", sorted(SHIPPED))
def test_all_that_come_with_retouch_speak_the_protocols_languages(name, protocol):
    instrument = load(None, name, protocol.languages, protocol.methods)
    assert set(instrument.title) >= {"en", "de", "nl"}


def test_the_tlx_is_the_paper_form(tlx):
    scales = [question for question in tlx.questions if isinstance(question, Scale)]
    assert [scale.name for scale in scales] == list(SOURCES)
    assert all(scale.ticks == tuple(range(0, 101, 5)) for scale in scales)
    assert {scale.name: scale.left["en"] for scale in scales if scale.left["en"] != "Low"} == {"performance": "Good"}
    assert len(tlx.question("pairs").answers) == 15


def test_a_workload_is_the_weighted_mean_whose_weights_sum_to_fifteen(tlx):
    # Who always takes the first of two weighs the sources 5, 4, 3, 2, 1, 0.
    ratings = (10, 20, 30, 40, 50, 60)
    answers = tlx_answers(ratings, first)
    tlx.check(answers)
    weights = tlx.scores[0].weights(answers)
    assert [weights[name] for name in SOURCES] == [5, 4, 3, 2, 1, 0]
    assert weights.total() == 15
    expected = (5 * 10 + 4 * 20 + 3 * 30 + 2 * 40 + 1 * 50) / 15
    assert tlx.scored(answers) == {"workload": pytest.approx(expected), "raw_workload": pytest.approx(35.0)}


@pytest.mark.parametrize("seed", range(5))
def test_any_workload_lies_between_the_ratings_and_equals_equal_ones(tlx, seed):
    rng = random.Random(seed)
    ratings = [5 * rng.randrange(21) for _ in SOURCES]

    def pick(*pair):
        return rng.choice(pair)

    assert min(ratings) <= tlx.scored(tlx_answers(ratings, pick))["workload"] <= max(ratings)
    assert tlx.scored(tlx_answers([65] * 6, pick))["workload"] == pytest.approx(65.0)


def test_a_pair_counts_whichever_side_was_shown_first(tlx):
    answers = tlx_answers((10, 20, 30, 40, 50, 60), first)
    turned = {"/".join(reversed(name.split("/"))): answer for name, answer in answers.items()}
    tlx.check(turned)
    assert tlx.scored(turned) == tlx.scored(answers)


@pytest.mark.parametrize(
    ("odd", "even", "score"), [(5, 1, 100.0), (1, 5, 0.0), (3, 3, 50.0), (4, 2, 75.0), (5, 5, 50.0)]
)
def test_a_usability_is_brookes(odd, even, score):
    sus = load(None, "sus")
    answers = {f"q{number}": odd if number % 2 else even for number in range(1, 11)}
    sus.check(answers)
    assert sus.scored(answers) == {"usability": pytest.approx(score)}


def test_a_reversed_item_counts_the_other_way_round():
    trust = load(None, "trust")
    answers = {question.name: 7 for question in trust.questions} | {"guard": 1}
    assert trust.scored(answers) == {"trust": pytest.approx(7.0)}


@pytest.mark.parametrize(
    ("change", "name", "reason"),
    [
        ({"mental": None}, "mental", "there is no answer"),
        ({"mental/physical": None}, "mental/physical", "there is no answer"),
        ({"mental": 101}, "mental", "101 is none of its ticks: 0 to 100 in steps of 5"),
        ({"mental": 7}, "mental", "7 is none of its ticks"),
        ({"mental": True}, "mental", "a number is wanted"),
        ({"mental": float("nan")}, "mental", "a number is wanted"),
        ({"mental": "50"}, "mental", "a number is wanted"),
        ({"mental/physical": "effort"}, "mental/physical", "'effort' is none of the two"),
        ({"physical/mental": "mental"}, "mental/physical", "it is answered twice"),
        ({"boredom": 5}, "boredom", "nasa_tlx has no such question"),
    ],
)
def test_what_is_missing_unknown_or_out_of_range_is_refused_by_its_name(tlx, change, name, reason):
    answers = {**tlx_answers((50,) * 6, first), **change}
    with pytest.raises(AnswerRefused) as caught:
        tlx.check({name: answer for name, answer in answers.items() if answer is not None})
    assert caught.value.question == name
    assert reason in caught.value.reason


def test_a_text_is_wanted_where_it_is_required_and_no_longer_than_it_may_be():
    form = load(None, "participant")
    answers = {"field": "  "}
    assert ("field", "there is no answer") in list(form.faults(answers))
    assert ("field", "it has 121 characters, of at most 120") in list(form.faults({"field": "x" * 121}))


def test_what_is_not_required_may_stay_empty(protocol):
    form = load(None, "preference", protocol.languages, protocol.methods)
    answers = {"preferred": "OnKey", "least": "OffKey", "why": "It is quick."}
    form.check(answers)
    form.check({**answers, "remarks": ""})


def test_the_methods_that_are_chosen_among_are_the_protocols(protocol):
    form = load(None, "preference", protocol.languages, protocol.methods)
    options = form.question("preferred").options
    assert [option.name for option in options] == ["OnStyl", "OnKey", "OffStyl", "OffKey"]
    assert options[1].text["de"].startswith("OnKey: Sie korrigieren")


def test_an_order_asks_for_all_once_with_pairs_mixed_and_turned(tlx):
    orders = [shown_order(tlx, np.random.default_rng(seed)) for seed in range(20)]
    assert all(order[:6] == SOURCES for order in orders)
    assert all(len({tuple(sorted(name.split("/"))) for name in order}) == 21 for order in orders)
    assert len(set(orders)) == 20
    assert {"mental/physical", "physical/mental"} <= {name for order in orders for name in order}


def test_an_order_is_its_seeds(tlx):
    assert shown_order(tlx, np.random.default_rng(3)) == shown_order(tlx, np.random.default_rng(3))


STRANGERS = """
format = 1
name = "presence"
version = "2026-1"
source = "ours"
title = { en = "Presence", fr = "Présence" }

[[questions]]
kind = "scale"
name = "there"
low = -3
high = 3
text = { en = "I was there", fr = "J'y étais" }
left = { en = "no", fr = "non" }
right = { en = "yes", fr = "oui" }

[[questions]]
kind = "number"
name = "hours"
low = 0
high = 24
whole = false
text = { en = "Slept", fr = "Dormi" }

[[scores]]
kind = "mean"
name = "presence"
of = ["there"]
range = [0, 1]
"""


@pytest.fixture
def strangers(tmp_path):
    """A function that loads a stranger's questionnaire, with a text put in another's place."""

    def load_theirs(old="", new="", languages=("en", "fr")):
        assert old in STRANGERS
        (tmp_path / "instruments").mkdir(exist_ok=True)
        (tmp_path / "instruments" / "presence.toml").write_text(STRANGERS.replace(old, new, 1), encoding="utf-8")
        return load(tmp_path, "presence", languages)

    return load_theirs


def test_a_strangers_file_works(strangers):
    theirs = strangers()
    theirs.check({"there": -1, "hours": 7.5})
    assert theirs.scored({"there": -1, "hours": 7.5}) == {"presence": pytest.approx(1 / 3)}


def test_a_studys_own_goes_before_the_one_of_that_name_that_comes_with_retouch(tmp_path):
    (tmp_path / "instruments").mkdir()
    own = SHIPPED["sus"].read_text(encoding="utf-8").replace('version = "1"', 'version = "ours"')
    (tmp_path / "instruments" / "sus.toml").write_text(own, encoding="utf-8")
    assert load(tmp_path, "sus").version == "ours"
    assert load(None, "sus").version == "1"


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("format = 1", "format = 9", "format: this version reads format 1, the file says 9"),
        ('name = "presence"', 'name = "other"', "name: it says other, the file is called presence.toml"),
        ('"Presence", fr = "Présence"', '"Presence"', "title: there is no text in fr"),
        (
            'text = { en = "Slept", fr = "Dormi" }',
            'text = { en = "Slept" }',
            "questions: hours: there is no text in fr",
        ),
        ('name = "hours"', 'name = "there"', "questions: there stands there twice"),
        ("high = 3", "high = -3", "questions: there: from -3 to -3 there are no steps of 1"),
        ("high = 24", "high = -1", "questions: hours: nothing is between 0 and -1"),
        ('of = ["there"]', 'of = ["hours"]', "scores: presence: hours is no scale"),
        ("range = [0, 1]", "range = [1, 0]", "scores: presence: a range is a low and a high number"),
        ("range = [0, 1]", 'reversed = ["hours"]', "scores: presence: hours is reversed, and not in it"),
        (
            'kind = "number"',
            'kind = "choice"',
            "[[questions]] number 2: unknown key low; only others of these kinds have it",
        ),
        (
            'kind = "number"',
            'kind = "numbers"',
            "[[questions]] number 2, kind: invalid value 'numbers'; one of scale, choice",
        ),
        (
            'text = { en = "Slept", fr = "Dormi" }',
            'txet = { en = "Slept", fr = "Dormi" }',
            "[[questions]] number 2: unknown key txet; did you mean text?",
        ),
        (
            'kind = "number"',
            'kind = "number"\nqqq = 1',
            "[[questions]] number 2: unknown key qqq; one of name, text, about, required, low, high, whole",
        ),
    ],
)
def test_what_contradicts_itself_is_told_in_one_line_with_its_place(strangers, old, new, said):
    with pytest.raises((ProtocolUnfit, ConfigurationError), match=r"presence\.toml: ") as caught:
        strangers(old, new)
    assert "\n" not in str(caught.value)
    assert said in str(caught.value)


def test_a_language_of_the_protocol_that_is_missing_is_told(strangers):
    with pytest.raises(ProtocolUnfit, match="title: there is no text in de"):
        strangers(languages=("en", "de"))


def test_a_name_that_nothing_has_is_told_with_the_nearest(tmp_path):
    with pytest.raises(ProtocolUnfit, match=r"nasa_tix\.toml: instruments: there is no such file; .*nasa_tlx"):
        load(tmp_path, "nasa_tix")


def test_a_protocol_has_all_questionnaires_that_it_names(protocol):
    assert set(of_protocol(protocol, None)) == {"participant", "nasa_tlx"}


def test_a_key_that_is_missing_is_no_value_to_choose(strangers):
    with pytest.raises(ConfigurationError) as caught:
        strangers('text = { en = "Slept", fr = "Dormi" }', "")
    assert str(caught.value).endswith("[[questions]] number 2: the key is missing: `text`")
