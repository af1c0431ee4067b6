import math

import pytest

from protocol.messages import AuthorityEvent, AuthorityRequest
from protocol.queries import AnswerRequest, ReleaseAuthority, RevokeAuthority
from services.process.config import LONGEST_LEASE_S
from services.robot.authority import NOBODY, Lease
from services.robot.refusal import Refusal

SECOND = 1_000_000_000


def test_another_holder_is_refused_by_name_while_the_lease_lives():
    lease = Lease(1.0)
    lease.acquire("ann", 0)
    with pytest.raises(Refusal, match="ann holds the authority"):
        lease.acquire("bob", SECOND)
    assert lease.acquire("bob", SECOND + 1) > 0


def test_take_over_fences_the_former_holder_off():
    lease = Lease(1.0)
    former = lease.acquire("ann", 0)
    present = lease.acquire("bob", 0, take_over=True, reason="it burns")
    lease.check(present)
    with pytest.raises(Refusal, match="bob"):
        lease.check(former)
    lease.renew("ann", former, "station", SECOND)
    lease.expire(SECOND + 1)
    assert lease.holder == NOBODY


def test_the_lease_lives_as_long_as_it_is_renewed():
    lease = Lease(1.0)
    epoch = lease.acquire("ann", 0)
    for now in range(0, 10 * SECOND, SECOND // 2):
        lease.renew("ann", epoch, "station", now)
        lease.expire(now)
        assert lease.holder == "ann"
    lease.expire(12 * SECOND)
    with pytest.raises(Refusal, match="nobody"):
        lease.check(epoch)


def test_a_refusal_names_the_person_and_not_the_station():
    lease = Lease(1.0)
    epoch = lease.acquire("station-1f3a", 0, operator="ann")
    for refused in (
        lambda: lease.acquire("station-77b0", 0, operator="bob"),
        lambda: lease.check(epoch + 1),
        lambda: lease.release(ReleaseAuthority("station-77b0", epoch)),
    ):
        with pytest.raises(Refusal, match="ann"):
            refused()


def test_only_the_holder_releases():
    lease = Lease(1.0)
    epoch = lease.acquire("ann", 0)
    with pytest.raises(Refusal, match="does not hold"):
        lease.release(ReleaseAuthority("bob", epoch))
    with pytest.raises(Refusal, match="epoch"):
        lease.release(ReleaseAuthority("ann", epoch + 1))
    lease.release(ReleaseAuthority("ann", epoch))
    assert lease.expires_in_s(0) == 0.0


def test_the_lease_says_how_long_it_lasts():
    lease = Lease(1.0)
    epoch = lease.acquire("ann", 0)
    assert lease.expires_in_s(0) == 1.0
    assert lease.expires_in_s(SECOND // 4) == 0.75
    lease.renew("ann", epoch, "station", SECOND // 2)
    assert lease.expires_in_s(SECOND // 2) == 1.0
    assert lease.expires_in_s(5 * SECOND) == 0.0


def test_a_renewal_that_comes_late_does_not_shorten_the_lease():
    lease = Lease(1.0)
    epoch = lease.acquire("ann", SECOND)
    lease.renew("ann", epoch, "station", SECOND // 2)
    assert lease.expires_in_s(SECOND) == 1.0


def test_nothing_runs_out_where_nobody_holds_it():
    lease = Lease(1.0, epoch=7)
    lease.expire(5 * SECOND)
    assert lease.epoch == 7


def test_a_command_of_another_epoch_is_refused_with_both_and_who_holds_it():
    lease = Lease(1.0, epoch=7)
    lease.acquire("ann", 0)
    with pytest.raises(Refusal) as refused:
        lease.check(7)
    assert str(refused.value) == "the command is of epoch 7, the authority of epoch 8 is ann's"


def test_the_lease_ends_after_its_last_nanosecond():
    lease = Lease(1.0)
    lease.acquire("ann", 0)
    lease.expire(SECOND)
    assert lease.holder == "ann"
    lease.expire(SECOND + 1)
    assert lease.holder == NOBODY


@pytest.mark.parametrize("setting", [3.001, 1e9, math.inf, math.nan])
def test_no_setting_makes_the_lease_last_longer_than_its_bound(setting):
    lease = Lease(setting)
    lease.acquire("ann", 0)
    assert lease.expires_in_s(0) == LONGEST_LEASE_S


def test_nobody_has_no_silence_and_a_new_holder_has_not_been_heard():
    lease = Lease(1.0)
    assert lease.silence_s(0) is None
    epoch = lease.acquire("ann", 0)
    assert lease.silence_s(SECOND) is None
    lease.renew("ann", epoch, "station", 0)
    assert lease.silence_s(0) == 0.0
    lease.renew("ann", epoch, "station", SECOND)
    assert lease.silence_s(SECOND + SECOND // 4) == 0.25
    lease.renew("ann", epoch, "station", SECOND // 2)
    assert lease.silence_s(SECOND + SECOND // 4) == 0.25
    lease.acquire("ann", 2 * SECOND)
    assert lease.silence_s(2 * SECOND) is None


def test_only_the_holder_under_the_present_epoch_is_covered():
    lease = Lease(1.0)
    assert not lease.covers(NOBODY, lease.epoch, "master")
    epoch = lease.acquire("ann", 0)
    assert lease.covers("ann", epoch, "master")
    assert not lease.covers("bob", epoch, "master")
    assert not lease.covers("ann", epoch - 1, "master")
    lease.end("eve")
    assert not lease.covers("ann", epoch, "master")
    assert not lease.covers(NOBODY, lease.epoch, "master")


def test_the_operator_goes_with_the_authority():
    lease = Lease(1.0)
    lease.acquire("station-1", 0, operator="Ann")
    assert lease.operator == "Ann"
    lease.acquire("station-2", 0, take_over=True, reason="it burns")
    assert lease.operator == ""
    lease.acquire("station-2", 0, operator="Bob")
    lease.end("eve")
    assert lease.operator == ""


def test_a_release_of_what_nobody_holds_says_so():
    with pytest.raises(Refusal, match="'ann' does not hold the authority: nobody does"):
        Lease(1.0).release(ReleaseAuthority("ann", 0))
    lease = Lease(1.0)
    lease.acquire("bob", 0)
    with pytest.raises(Refusal, match="'ann' does not hold the authority: bob does"):
        lease.release(ReleaseAuthority("ann", 1))


def test_the_first_epoch_that_is_given_out_is_above_the_one_to_start_from():
    assert (Lease(1.0).epoch, Lease(1.0).acquire("ann", 0)) == (0, 1)


def test_each_change_raises_the_epoch_by_one():
    lease = Lease(1.0, epoch=41)
    assert lease.acquire("ann", 0) == 42
    lease.end("eve")
    assert lease.epoch == 43


def test_a_nameless_holder_is_refused():
    with pytest.raises(Refusal, match="name"):
        Lease(1.0).acquire("", 0)


@pytest.mark.parametrize("reason", ["", "ok", "  .  "])
def test_a_take_over_and_a_revocation_need_a_reason(reason):
    lease = Lease(1.0)
    epoch = lease.acquire("ann", 0)
    with pytest.raises(Refusal, match="a take-over needs a reason of at least 3 characters"):
        lease.acquire("bob", 0, take_over=True, reason=reason)
    with pytest.raises(Refusal, match="a revocation needs a reason"):
        lease.revoke(RevokeAuthority("eve", reason))
    lease.check(epoch)


def test_what_nobody_else_holds_needs_no_reason():
    lease = Lease(1.0)
    lease.acquire("ann", 0, take_over=True)
    lease.acquire("ann", 0, take_over=True)
    assert (lease.event, lease.reason) == (AuthorityEvent.ACQUIRED, "")


def test_a_revocation_leaves_the_authority_with_nobody_and_says_who_and_why():
    lease = Lease(1.0)
    epoch = lease.acquire("station-1", 0, operator="Ann")
    lease.revoke(RevokeAuthority("eve", " it is late "))
    assert (lease.holder, lease.event, lease.by, lease.before, lease.reason) == (
        NOBODY,
        AuthorityEvent.REVOKED,
        "eve",
        "Ann",
        "it is late",
    )
    with pytest.raises(Refusal, match="nobody holds"):
        lease.check(epoch)


def test_a_revocation_needs_a_name_and_somebody_who_holds_the_authority():
    lease = Lease(1.0)
    with pytest.raises(Refusal, match="nothing to revoke"):
        lease.revoke(RevokeAuthority("eve", "it is late"))
    lease.acquire("ann", 0)
    with pytest.raises(Refusal, match="needs a name"):
        lease.revoke(RevokeAuthority("", "it is late"))
    assert lease.holder == "ann"


def test_each_change_says_how_it_came_and_who_had_it_before():
    lease, told = Lease(1.0), []
    for change in (
        lambda: lease.acquire("ann", 0),
        lambda: lease.acquire("bob", 0, take_over=True, reason="she left"),
        lambda: lease.release(ReleaseAuthority("bob", lease.epoch)),
        lambda: lease.acquire("ann", 0),
        lambda: lease.expire(2 * SECOND),
        lambda: lease.acquire("ann", 2 * SECOND),
        lambda: lease.end("eve"),
    ):
        change()
        told.append((lease.event.value, lease.by, lease.before, lease.reason))
    assert told == [
        ("acquired", "ann", "", ""),
        ("taken_over", "bob", "ann", "she left"),
        ("released", "bob", "bob", ""),
        ("acquired", "ann", "", ""),
        ("expired", "ann", "ann", ""),
        ("acquired", "ann", "", ""),
        ("stopped", "eve", "ann", ""),
    ]


def test_another_persons_processes_cannot_use_an_authority_whose_epoch_they_have_read():
    lease = Lease(1.0)
    epoch = lease.acquire("ann", 0, operator="ann", process="station-ann")
    assert lease.covers("ann", epoch, "master-ann")
    assert not lease.covers("ann", epoch, "master-bob")
    lease.check_sender(epoch, "station-ann")
    with pytest.raises(Refusal, match="station-bob"):
        lease.check_sender(epoch, "station-bob")
    lease.renew("ann", epoch, "station-bob", SECOND // 2)
    lease.expire(SECOND + 1)
    assert lease.holder == NOBODY


def test_an_authority_that_was_given_is_its_new_holders():
    lease = Lease(1.0)
    epoch = lease.acquire("ann", 0, process="station-ann")
    lease.ask(AuthorityRequest(holder="bob", number=7, process="station-bob"), 0)
    lease.answer(AnswerRequest("ann", epoch, 7, give=True), 1)
    assert lease.covers("bob", lease.epoch, "master-bob")
    assert not lease.covers("bob", lease.epoch, "master-ann")
