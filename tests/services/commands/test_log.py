"""What a robot has written down, at a terminal."""

import json
from datetime import UTC, datetime

import pytest

from protocol.messages import AuthorityEvent, Cut, Mode, Origin
from services import cli
from services.evidence.events import (
    AuthorityChanged,
    Began,
    Commanded,
    EpisodeBegan,
    EpisodeEnded,
    StopChanged,
)
from services.evidence.ledger import LedgerFile
from tests.services.robot.site import AtOnce

AT = datetime(2026, 3, 1, 8, 0, tzinfo=UTC)


def began(scale):
    return Began(
        robot="kitchen",
        host="tiago",
        versions={"retouch": "0.1.0"},
        settings={"robot": {"velocity_scale": scale}},
    )


def authority(event, **changes):
    fields = {"epoch": 7, "holder": "desk", "operator": "Ann", "by": "Ann", "before": "Bob", "reason": ""}
    return AuthorityChanged(event=event, **(fields | changes))


EPISODE = EpisodeBegan(
    episode=3, epoch=7, operator="Ann", mode=Mode.REFINE, prediction=5, origin=Origin.MODEL, model_version=12
)
ENDED = EpisodeEnded(
    episode=3,
    operator="Ann",
    corrected=True,
    success=False,
    cut=Cut.STOPPED,
    reason="emergency stop by Bob",
    progress=0.5,
    duration=4.2,
    held=0.3,
    clamped=2,
)


@pytest.fixture
def log(tmp_path):
    """A function that writes a log; its path."""

    def write(*events):
        path = tmp_path / "evidence.jsonl"
        ledger = LedgerFile(path, AtOnce(), lambda: AT)
        for event in events:
            ledger.add(event)
        ledger.close()
        return path

    return write


def shown(capsys, path, *flags):
    code = cli.main(["log", "show", *flags, str(path)])
    return code, capsys.readouterr().out.splitlines()


@pytest.mark.parametrize(
    ("event", "words"),
    [
        (began(0.5), "kitchen began on tiago: retouch 0.1.0"),
        (authority(AuthorityEvent.ACQUIRED), "Ann has the authority, epoch 7"),
        (
            authority(AuthorityEvent.TAKEN_OVER, reason="it burns"),
            "Ann took the authority over from Bob, epoch 7: it burns",
        ),
        (authority(AuthorityEvent.GIVEN), "Bob gave the authority to Ann, epoch 7"),
        (authority(AuthorityEvent.GIVEN_BY_SILENCE), "Bob did not answer: Ann has the authority, epoch 7"),
        (authority(AuthorityEvent.RELEASED), "Ann gave the authority back, epoch 7"),
        (authority(AuthorityEvent.EXPIRED), "Ann was not heard any more: nobody has the authority, epoch 7"),
        (authority(AuthorityEvent.REVOKED, reason="unfit"), "Ann revoked Bob's authority, epoch 7: unfit"),
        (authority(AuthorityEvent.STOPPED), "nobody has the authority after the stop, epoch 7"),
        (
            Commanded(request="Reset", asker="station.Ann", said={"epoch": 7, "at": [0.85, 0.0512345], "request": 9}),
            "station.Ann asked for Reset: epoch 7, at (0.85, 0.05123)",
        ),
        (StopChanged(latched=True, by="Bob", reason="smoke", released_by=""), "EMERGENCY STOP by Bob: smoke"),
        (
            StopChanged(latched=False, by="Bob", reason="smoke", released_by="Ann"),
            "the emergency stop was released by Ann",
        ),
        (EPISODE, "episode 3 of Ann, under correction, model version 12 (model)"),
        (
            ENDED,
            "episode 3 ended: emergency stop by Bob; no success, corrected by Ann, 4.2 s, held for 0.3 s, clamped in "
            "2 periods",
        ),
    ],
)
def test_every_event_is_one_line_of_words(log, capsys, event, words):
    code, lines = shown(capsys, log(event))
    assert code == 0
    assert [line.split("  ")[-1] for line in lines] == [words]


def test_another_start_says_what_is_set_otherwise(log, capsys):
    _, lines = shown(capsys, log(began(0.5), began(0.5), began(0.25)))
    assert lines[1].endswith("kitchen began on tiago, settings and versions as before")
    assert lines[2].endswith("settings.robot.velocity_scale: 0.5, now 0.25")


def test_the_newest_entries_keep_their_numbers(log, capsys):
    _, lines = shown(capsys, log(*[EPISODE] * 5), "--last", "2")
    assert [line.split()[0] for line in lines] == ["4", "5"]


def test_what_somebody_s_program_sent_is_printed_and_nothing_else(log, capsys):
    path = log(StopChanged(latched=True, by="Bob", reason="\x1b[2Jgone\nline", released_by=""))
    assert shown(capsys, path)[1][0].endswith("EMERGENCY STOP by Bob: [2Jgone line")


def test_a_whole_log_says_its_newest_digest_and_one_that_was_changed_where(log, capsys):
    path = log(EPISODE, ENDED)
    assert cli.main(["log", "verify", str(path)]) == 0
    head = capsys.readouterr().out.split()[-1]
    assert head == json.loads(path.read_text().splitlines()[-1])["chain"]
    path.write_text(path.read_text().replace("Bob", "Eve"))
    assert cli.main(["log", "verify", "--head", head, str(path)]) == 1
    assert f"{path}: line 2: it was changed" in capsys.readouterr().out


def test_a_log_whose_end_is_gone_does_not_have_the_digest_that_was_noted(log, capsys):
    path = log(EPISODE)
    assert cli.main(["log", "verify", "--head", "ab" * 32, str(path)]) == 1
    assert "no entry has the digest abab" in capsys.readouterr().out


def test_a_robot_without_a_log_is_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert cli.main(["log", "show", "--robot", "nobody"]) == 2
    assert "there is no evidence log to read" in capsys.readouterr().err
