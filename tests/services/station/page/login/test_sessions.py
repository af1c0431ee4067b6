"""A session counts until it is ended, is not used, or its account is another one; and its token is nowhere."""

import msgspec
import pytest

from protocol.messages import Role
from services.accounts.account import Account, Accounts
from services.process.clock import ManualClock
from services.station.page.login.sessions import MOST, UNUSED_NS, Sessions

DIGEST = f"$argon2id$v=19$m=65536,t=3,p=1${'A' * 22}${'A' * 43}"
ANNA = Account("Anna", Role.OPERATOR, DIGEST)
CARL = Account("Carl", Role.OBSERVER, DIGEST)
BOTH = Accounts((ANNA, CARL))
UNUSED_S = UNUSED_NS / 1e9


@pytest.fixture
def clock():
    return ManualClock()


@pytest.fixture
def ended():
    return []


@pytest.fixture
def sessions(clock, ended):
    made = Sessions(clock)
    made.on_end = ended.append
    return made


def test_a_token_finds_its_session_and_nothing_else_does(sessions):
    tokens = [sessions.open(account) for account in (ANNA, CARL)]
    assert [sessions.find(token).account for token in tokens] == [ANNA, CARL]
    for other in ("", "x", tokens[0][:-1], tokens[0] + "A", tokens[0].swapcase()):
        assert sessions.find(other) is None


def test_every_token_has_256_bits_and_is_kept_by_its_digest_alone(sessions):
    tokens = {sessions.open(ANNA) for _ in range(20)}
    assert len(tokens) == 20
    assert all(len(token) == 43 for token in tokens)  # 32 bytes, six bits a character
    kept = str(vars(sessions))
    assert not any(token in kept for token in tokens)


def test_who_logs_out_is_out_everywhere_with_this_token_and_only_with_this(sessions, ended):
    one, other = sessions.open(ANNA), sessions.open(ANNA)
    session = sessions.find(one)
    sessions.end(session)
    assert (session.ended, ended) == (True, [session])
    assert sessions.find(one) is None
    assert sessions.find(other) is not None
    sessions.end(session)
    assert ended == [session]


def test_a_session_that_is_not_used_for_twelve_hours_ends(sessions, clock, ended):
    token = sessions.open(ANNA)
    clock.advance(UNUSED_S - 1.0)
    sessions.expire()
    assert ended == []
    clock.advance(1.0)
    sessions.expire()
    assert [session.account for session in ended] == [ANNA]
    assert sessions.find(token) is None


def test_one_that_is_used_goes_on(sessions, clock):
    token = sessions.open(ANNA)
    for _ in range(5):
        clock.advance(UNUSED_S - 1.0)
        assert sessions.find(token) is not None
    clock.advance(UNUSED_S)
    assert sessions.find(token) is None


@pytest.mark.parametrize(
    "accounts",
    [
        BOTH.without("Anna"),
        BOTH.with_changed(msgspec.structs.replace(ANNA, password=DIGEST.replace("AAAA", "BBBB"))),
        BOTH.with_changed(msgspec.structs.replace(ANNA, role=Role.OBSERVER)),
        Accounts(),
    ],
    ids=["removed", "password", "role", "unreadable"],
)
def test_whose_account_is_another_one_is_logged_out_everywhere_and_nobody_else_is(sessions, ended, accounts):
    tokens, carls = [sessions.open(ANNA) for _ in range(2)], sessions.open(CARL)
    sessions.follow(BOTH)
    assert ended == []
    sessions.follow(accounts)
    assert all(sessions.find(token) is None for token in tokens)
    assert (sessions.find(carls) is not None) == (accounts.find("Carl") is not None)


def test_of_too_many_the_one_that_was_unused_longest_ends(sessions, clock):
    first, second = sessions.open(ANNA), sessions.open(ANNA)
    clock.advance(1.0)
    sessions.find(first)
    clock.advance(1.0)
    tokens = [sessions.open(CARL) for _ in range(MOST - 1)]
    assert sessions.find(second) is None
    assert all(sessions.find(token) is not None for token in (first, *tokens))
