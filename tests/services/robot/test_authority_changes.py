"""Whatever happens to a lease, in any order: an epoch has one holder."""

from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import AuthorityRequest
from protocol.queries import AnswerRequest, ReleaseAuthority, RevokeAuthority
from services.robot.authority import NOBODY, Lease
from services.robot.refusal import Refusal

SECOND = 1_000_000_000
NAMES = st.sampled_from(["ann", "bob"])
ACTIONS = st.lists(
    st.one_of(
        st.tuples(st.just("acquire"), NAMES, st.booleans()),
        st.tuples(st.just("release"), NAMES, st.booleans()),
        st.tuples(st.just("renew"), NAMES, st.booleans()),
        st.tuples(st.just("revoke"), NAMES, st.booleans()),
        st.tuples(st.just("ask"), NAMES, st.booleans()),
        st.tuples(st.just("answer"), NAMES, st.booleans()),
        st.tuples(st.just("wait"), NAMES, st.booleans()),
    )
)


def carry_out(lease, what, number):
    """One of the things that may happen to a lease."""
    action, name, flag = what
    now = number * SECOND // 2
    question = lease.asking.question
    match action:
        case "acquire":
            lease.acquire(name, now, take_over=flag, reason="it burns")
        case "release":
            lease.release(ReleaseAuthority(name, lease.epoch))
        case "renew":
            lease.renew(name, lease.epoch, "station", now)
        case "revoke":
            lease.revoke(RevokeAuthority(name, "it burns"))
        case "ask":
            lease.ask(AuthorityRequest(holder=name, number=number), now)
        case "answer":
            lease.answer(AnswerRequest(name, lease.epoch, question.number if question else 0, flag), now)
        case "wait":
            lease.expire(now)


@given(ACTIONS)
def test_every_change_raises_the_epoch_and_no_epoch_commands_twice(actions):
    lease, owner = Lease(1.0, epoch=7), {}
    for number, what in enumerate(actions, 1):
        holder, epoch, asked = lease.holder, lease.epoch, lease.asking.question
        try:
            carry_out(lease, what, number)
        except Refusal:
            assert lease.holder != holder or lease.epoch == epoch
        assert lease.epoch >= epoch
        if lease.holder != holder:
            assert lease.epoch > epoch
            assert lease.asking.question is None
        if lease.holder != NOBODY:
            assert owner.setdefault(lease.epoch, lease.holder) == lease.holder
        assert asked is None or asked.holder != holder, "nobody asks for what is their own"
