"""What comes over a tab's connection counts or is refused in one line, and the connection stays."""

import contextlib
import json

import pytest

pytest.importorskip("websockets")
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from services.study.events import Consented
from tests.ports import free_port
from tests.study_harness import served


@pytest.fixture
def study(tmp_path):
    with served(tmp_path / "raw", free_port()) as one:
        one.desk.conductor.enrol(1, "en")
        yield one


@pytest.fixture
def tab(study):
    """A function that connects as a tab of the page does."""
    host = study.page.console_url.split("/")[2]
    with contextlib.ExitStack() as opened:
        yield lambda path, origin=f"http://{host}": opened.enter_context(
            connect(f"ws://{host}{path}", origin=origin, open_timeout=20.0)
        )


def reply(tab):
    """The answer to an act, whatever is shown meanwhile."""
    while "refused" not in (message := json.loads(tab.recv(timeout=20.0))):
        pass
    return message


def test_a_tab_is_shown_what_there_is_at_once(tab):
    view = json.loads(tab("/link/1").recv(timeout=20.0))
    assert (view["number"], view["stage"]["stage"]) == (1, "consent")


def test_an_act_counts_once_and_is_answered_by_its_number(tab, study):
    one = tab("/link/1")
    act = {"act": "consent", "version": "2", "language": "en"}
    one.send(json.dumps({"id": 5, "act": act}))
    assert reply(one) == {"id": 5, "refused": "", "faults": []}
    one.send(json.dumps({"id": 6, "act": act}))
    assert "not at consent any more" in reply(one)["refused"]
    assert sum(isinstance(event, Consented) for event in study.events) == 1


def test_what_is_wrong_with_a_form_is_told_question_by_question(tab, study):
    study.desk.conductor.consent(1, "en")
    one = tab("/link/1")
    one.send(
        json.dumps(
            {
                "id": 1,
                "act": {
                    "act": "fill",
                    "part": "participant",
                    "version": "1",
                    "language": "en",
                    "answers": {"age": "young"},
                },
            }
        )
    )
    said = reply(one)
    assert said["refused"].startswith("age: 'young' is not offered")
    assert [name for name, _ in said["faults"]] == [
        "age",
        "gender",
        "field",
        "technical",
        "gaming",
        "teleoperation",
        "handedness",
    ]


@pytest.mark.parametrize("said", ["", "{", "[]", '{"id": 1, "act": {"act": "fly"}}', '{"id": 1}', "[" * 5000])
def test_what_no_page_says_is_refused_and_the_tab_goes_on(tab, said):
    one = tab("/link/1")
    one.send(said)
    assert "load it anew" in reply(one)["refused"]
    one.send(json.dumps({"id": 2, "act": {"act": "consent", "version": "2", "language": "en"}}))
    assert reply(one)["id"] == 2


def test_a_participants_page_does_nothing_that_is_the_experimenters(tab):
    one = tab("/link/1")
    one.send(json.dumps({"id": 1, "act": {"act": "abort", "number": 1, "reason": "mine"}}))
    assert "load it anew" in reply(one)["refused"]


def test_another_site_is_not_connected(tab):
    with pytest.raises(InvalidStatus):
        tab("/link/console", origin="http://evil.example")


def test_the_tab_of_a_participant_whom_there_is_not_is_told_goodbye(tab):
    with pytest.raises(ConnectionClosed) as caught:
        tab("/link/9").recv(timeout=20.0)
    assert caught.value.rcvd.code == 4404
