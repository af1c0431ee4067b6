import pytest
from hypothesis import given
from hypothesis import strategies as st

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
        st.tuples(st.just("wait"), NAMES, st.booleans()),
    )
)


def test_another_holder_is_refused_by_name_while_the_lease_lives():
    lease = Lease(1.0)
    lease.acquire("ann", 0)
    with pytest.raises(Refusal, match="ann holds the authority"):
        lease.acquire("bob", SECOND)
    assert lease.acquire("bob", SECOND + 1) > 0


def test_take_over_fences_the_former_holder_off():
    lease = Lease(1.0)
    former = lease.acquire("ann", 0)
    present = lease.acquire("bob", 0, take_over=True)
    lease.check(present)
    with pytest.raises(Refusal, match="bob"):
        lease.check(former)
    lease.renew("ann", former, SECOND)
    lease.expire(SECOND + 1)
    assert lease.holder == NOBODY


def test_the_lease_lives_as_long_as_it_is_renewed():
    lease = Lease(1.0)
    epoch = lease.acquire("ann", 0)
    for now in range(0, 10 * SECOND, SECOND // 2):
        lease.renew("ann", epoch, now)
        lease.expire(now)
        assert lease.holder == "ann"
    lease.expire(12 * SECOND)
    with pytest.raises(Refusal, match="nobody"):
        lease.check(epoch)


def test_only_the_holder_releases():
    lease = Lease(1.0)
    epoch = lease.acquire("ann", 0)
    with pytest.raises(Refusal, match="does not hold"):
        lease.release("bob", epoch)
    with pytest.raises(Refusal, match="epoch"):
        lease.release("ann", epoch + 1)
    lease.release("ann", epoch)
    assert lease.expires_in_s(0) == 0.0


def test_a_nameless_holder_is_refused():
    with pytest.raises(Refusal, match="name"):
        Lease(1.0).acquire("", 0)


@given(ACTIONS)
def test_every_change_raises_the_epoch_and_no_epoch_commands_twice(actions):
    lease, now, owner = Lease(1.0, epoch=7), 0, {}
    for action, name, flag in actions:
        before = (lease.holder, lease.epoch)
        try:
            if action == "acquire":
                owner[lease.acquire(name, now, take_over=flag)] = name
            elif action == "release":
                lease.release(name, lease.epoch)
            elif action == "renew":
                lease.renew(name, lease.epoch, now)
            elif action == "revoke":
                lease.revoke()
            else:
                now += SECOND
                lease.expire(now)
        except Refusal:
            if lease.holder == before[0]:
                assert lease.epoch == before[1]
        assert lease.epoch >= before[1]
        if lease.holder != before[0]:
            assert lease.epoch > before[1]
        if lease.holder != NOBODY:
            assert owner[lease.epoch] == lease.holder
