"""A participant's way is the protocol's and the journal's: whoever reads them finds the same next part."""

import pytest

from services.study.events import Answered, Began, Consented, Ended, Enrolled, Entry, Invalid, Withdrawn
from services.study.protocol.protocol import load
from services.study.protocols import SHIPPED
from services.study.session.course import Adapt, Agree, Fill, Rest, Train, course, participants

PROTOCOL = load(SHIPPED["thesis"])
ORDER = PROTOCOL.order.table[1]


def after(*events):
    """The participant after these events."""
    enrolled = Enrolled(participant=4, order=ORDER, group=1, language="en")
    entries = [Entry(number=number, at="", event=event) for number, event in enumerate((enrolled, *events), 1)]
    return participants(entries)[4]


def over(part, *, passed=True):
    if isinstance(part, Agree):
        return Consented(participant=4, version="1", language="en", text="x")
    if isinstance(part, Fill):
        return Answered(
            participant=4,
            instrument=part.instrument,
            version="1",
            language="en",
            after=part.after,
            shown=(),
            answers={},
        )
    return Ended(participant=4, part=part.name, passed=passed)


def test_the_parts_are_consent_form_each_method_with_its_questionnaire_and_breaks_between():
    parts = course(PROTOCOL, ORDER)
    assert parts[:2] == (Agree(), Fill("participant"))
    assert parts[2:8] == (
        Train("OnKey"),
        *(Adapt("OnKey", model) for model in (1, 2, 3)),
        Fill("nasa_tlx", "OnKey"),
        Rest("OnKey"),
    )
    assert parts[-1] == Fill("nasa_tlx", ORDER[-1])
    assert len({part.name for part in parts}) == len(parts) == 2 + 4 * 5 + 3


def test_after_each_part_comes_the_next_one_and_none_after_the_last():
    parts, done = course(PROTOCOL, ORDER), []
    for part in parts:
        assert after(*done).next(PROTOCOL) == part
        done.append(over(part))
    assert after(*done).next(PROTOCOL) is None


def test_a_method_whose_training_failed_is_rated_and_not_used():
    done = [over(part, passed=not isinstance(part, Train)) for part in course(PROTOCOL, ORDER)[:3]]
    assert after(*done).next(PROTOCOL) == Fill("nasa_tlx", "OnKey")


def test_a_model_that_was_not_adapted_is_followed_by_the_next_model():
    parts = course(PROTOCOL, ORDER)
    assert after(*(over(part, passed=not isinstance(part, Adapt)) for part in parts[:4])).next(PROTOCOL) == parts[4]


@pytest.mark.parametrize("repeat", [True, False])
def test_what_is_invalid_is_done_again_where_the_experimenter_says_so(repeat):
    parts = course(PROTOCOL, ORDER)
    done = [over(part) for part in parts[:5]]
    invalid = Invalid(participant=4, part=parts[3].name, reason="the fire alarm", repeat=repeat)
    assert after(*done, invalid).next(PROTOCOL) == (parts[3] if repeat else parts[5])


def test_what_is_invalid_and_not_repeated_is_over_though_it_did_not_end():
    parts = course(PROTOCOL, ORDER)
    invalid = Invalid(participant=4, part=parts[2].name, reason="the fire alarm", repeat=False)
    begun = [*(over(part) for part in parts[:2]), Began(participant=4, part=parts[2].name), invalid]
    assert after(*begun).next(PROTOCOL) == parts[3]
    again = Invalid(participant=4, part=parts[2].name, reason="it does count", repeat=True)
    assert after(*begun, again).next(PROTOCOL) == parts[2]


def test_nothing_comes_after_a_withdrawal():
    assert after(Withdrawn(participant=4, delete=True)).next(PROTOCOL) is None
