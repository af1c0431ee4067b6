"""Who may command: a lease with an epoch that fences off whoever held it before."""

from protocol.messages import SHORTEST_REASON, AuthorityEvent, AuthorityRequest
from protocol.names import person
from protocol.queries import AnswerRequest, ReleaseAuthority, RevokeAuthority
from services.process.config import LONGEST_LEASE_S
from services.robot.asking import Asking
from services.robot.refusal import Refusal

NOBODY = ""


class Lease:
    """The authority of at most one holder at a time.

    The epoch grows with every change, losing the authority included, so that a command of an earlier one is known.

    Attributes:
        event: how it came to be as it is.
        by: who caused that, for people.
        before: who had it before.
        reason: why it was taken over or revoked.
        asking: who asks for it.

    Args:
        duration_s: how long it lasts without renewal, at most `LONGEST_LEASE_S` [s].
        epoch: to start from; above every epoch that an earlier incarnation of the process gave out.
    """

    def __init__(self, duration_s: float, epoch: int = 0) -> None:
        self.duration_s = min(LONGEST_LEASE_S, duration_s)
        self.epoch = epoch
        self.holder = NOBODY
        self.operator = NOBODY
        self.event = AuthorityEvent.NONE
        self.by = self.before = self.reason = ""
        self.asking = Asking()
        self._person = NOBODY
        self._expires_ns = 0
        self._renewed_ns: int | None = None

    @property
    def who(self) -> str:
        """Holds it, for people: the person, or the station of one who gave no name; empty for nobody."""
        return self.operator or self.holder

    def acquire(
        self,
        holder: str,
        now_ns: int,
        *,
        operator: str = "",
        take_over: bool = False,
        reason: str = "",
        process: str = "",
    ) -> int:
        """Give the authority to a holder; its new epoch.

        Args:
            holder: the station's name.
            now_ns: the time.
            operator: the person there, as the station says.
            take_over: end another one's.
            reason: why.
            process: that asks, as the network knows it: its person's other processes may use the authority, too.

        Raises:
            Refusal: another one holds it and it is not taken over, or without a reason, or the name is empty.
        """
        self.expire(now_ns)
        if holder == NOBODY:
            raise Refusal("the authority needs a holder's name: give one")
        if self.holder in (NOBODY, holder):
            self._change(AuthorityEvent.ACQUIRED, operator or holder, holder, operator)
        elif take_over:
            why = checked_reason("a take-over", reason)
            self._change(AuthorityEvent.TAKEN_OVER, operator or holder, holder, operator, reason=why)
        else:
            raise Refusal(f"{self.who} holds the authority: ask for it, or take over")
        self._person = person(process)
        self._begin(now_ns)
        return self.epoch

    def ask(self, request: AuthorityRequest, received_ns: int) -> None:
        """Somebody asks for the authority; heard only where another one has it."""
        if self.holder not in (NOBODY, request.holder):
            self.asking.hear(request, received_ns)

    def answer(self, request: AnswerRequest, now_ns: int) -> None:
        """The holder gives the authority to who asks for it, or keeps it.

        Raises:
            Refusal: it is not this holder's, not of this epoch, or nobody asks by this number any more.
        """
        self._check_holder(request.holder)
        self.check(request.epoch)
        question = self.asking.question
        if question is None or question.number != request.number:
            raise Refusal("nobody asks for the authority any more: there is nothing to answer")
        if request.give:
            self._hand_over(AuthorityEvent.GIVEN, now_ns)
        else:
            self.asking.decline()

    def covers(self, holder: str, epoch: int, process: str) -> bool:
        """Whether what a process sends for a holder under an epoch counts now: another person's does not."""
        mine = (self.holder, self.epoch, self._person)
        return self.holder != NOBODY and (holder, epoch, person(process)) == mine

    def renew(self, holder: str, epoch: int, process: str, received_ns: int) -> bool:
        """Prolong the lease from when its holder was heard; a stranger's renewal does nothing. Whether it counted."""
        counts = self.covers(holder, epoch, process)
        if counts:
            self._renewed_ns = max(self._renewed_ns or 0, received_ns)
            self._expires_ns = max(self._expires_ns, received_ns + self._duration_ns)
        return counts

    def silence_s(self, now_ns: int) -> float | None:
        """Time since the newest renewal [s]; None where there was none under this epoch."""
        return (now_ns - self._renewed_ns) / 1e9 if self._renewed_ns is not None else None

    def release(self, request: ReleaseAuthority) -> None:
        """Take the authority back from its holder.

        Raises:
            Refusal: it is not this holder's, or not of this epoch.
        """
        self._check_holder(request.holder)
        self.check(request.epoch)
        self._change(AuthorityEvent.RELEASED, self.who)

    def revoke(self, request: RevokeAuthority) -> None:
        """Take the authority from whoever holds it; the robot holds, and waits for whoever asks for it next.

        Raises:
            Refusal: nobody holds it, or it is not said who revokes it and why.
        """
        if not request.by:
            raise Refusal("a revocation needs a name: say who revokes the authority")
        why = checked_reason("a revocation", request.reason)
        if self.holder == NOBODY:
            raise Refusal("nobody holds the authority: there is nothing to revoke")
        self._change(AuthorityEvent.REVOKED, request.by, reason=why)

    def end(self, by: str) -> None:
        """A stop was released: whoever held the authority has lost it."""
        self._change(AuthorityEvent.STOPPED, by)

    def expire(self, now_ns: int) -> None:
        """Let the lease run out where it was not renewed in time; silence gives it to who asks for it."""
        self.asking.expire(now_ns)
        if self.holder != NOBODY and now_ns > self._expires_ns:
            self._change(AuthorityEvent.EXPIRED, self.who)
        if self.asking.question is not None and self.asking.left_s(now_ns) <= 0.0:
            self._hand_over(AuthorityEvent.GIVEN_BY_SILENCE, now_ns)

    def check(self, epoch: int) -> None:
        """Let a command of the present epoch pass.

        Raises:
            Refusal: nobody holds the authority, or the command is of another epoch.
        """
        if self.holder == NOBODY:
            raise Refusal("nobody holds the authority: acquire it first")
        if epoch != self.epoch:
            raise Refusal(f"the command is of epoch {epoch}, the authority of epoch {self.epoch} is {self.who}'s")

    def check_sender(self, epoch: int, process: str) -> None:
        """Let a command pass that does not use another person's authority: everybody can read of which epoch it is.

        Raises:
            Refusal: the process is another person's.
        """
        if self.holder != NOBODY and epoch == self.epoch and person(process) != self._person:
            raise Refusal(f"the authority is {self.who}'s: {process!r} cannot command under it")

    def expires_in_s(self, now_ns: int) -> float:
        """Until the lease runs out [s]; 0 where nobody holds it."""
        return max(0, self._expires_ns - now_ns) / 1e9 if self.holder != NOBODY else 0.0

    @property
    def _duration_ns(self) -> int:
        return round(self.duration_s * 1e9)

    def _hand_over(self, event: AuthorityEvent, now_ns: int) -> None:
        question = self.asking.question
        if question is not None:
            self._change(event, self.who, question.holder, question.operator)
            self._person = question.person
            self._begin(now_ns)

    def _check_holder(self, holder: str) -> None:
        if self.holder != holder:
            raise Refusal(f"{holder!r} does not hold the authority: {self.who or 'nobody'} does")

    def _begin(self, now_ns: int) -> None:
        self._expires_ns = now_ns + self._duration_ns

    def _change(
        self, event: AuthorityEvent, by: str, holder: str = NOBODY, operator: str = "", *, reason: str = ""
    ) -> None:
        self.event, self.by, self.before, self.reason = event, by, self.who, reason
        self.holder, self.operator = holder, operator
        self.epoch += 1
        self.asking.forget()
        self._renewed_ns = None


def checked_reason(what: str, reason: str) -> str:
    """The reason, without what surrounds it.

    Raises:
        Refusal: it says nothing.
    """
    stripped = reason.strip()
    if len(stripped) < SHORTEST_REASON:
        raise Refusal(f"{what} needs a reason of at least {SHORTEST_REASON} characters: whoever loses it is told")
    return stripped
