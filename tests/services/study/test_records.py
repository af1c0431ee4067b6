"""What the journal comes to."""

from services.study.instruments.library import of_protocol
from services.study.protocol.protocol import load
from services.study.protocols import SHIPPED
from services.study.records import observed


def test_answers_about_participants_are_called_what_the_form_says():
    protocol = load(SHIPPED["thesis"])
    observations = observed(protocol, (), of_protocol(protocol, None), "")
    assert observations.called("age", "from_55") == "55–64"
    assert observations.levels("age", ["unsaid", "from_65", "from_18"]) == ["from_18", "from_65", "unsaid"]
