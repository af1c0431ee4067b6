"""Who may command: a lease with an epoch that fences off whoever held it before."""

from services.process.config import LONGEST_LEASE_S
from services.robot.refusal import Refusal

NOBODY = ""


class Lease:
    """The authority of at most one holder at a time.

    The epoch grows with every change, losing the authority included, so that a command of an earlier one is known.

    Args:
        duration_s: how long it lasts without renewal, at most `LONGEST_LEASE_S` [s].
        epoch: to start from; above every epoch that an earlier incarnation of the process gave out.
    """

    def __init__(self, duration_s: float, epoch: int = 0) -> None:
        self.duration_s = min(LONGEST_LEASE_S, duration_s)
        self.epoch = epoch
        self.holder = NOBODY
        self.operator = NOBODY
        self._expires_ns = 0
        self._renewed_ns: int | None = None

    @property
    def who(self) -> str:
        """Holds it, for people: the person, or the station of one who gave no name; empty for nobody."""
        return self.operator or self.holder

    def acquire(self, holder: str, now_ns: int, *, operator: str = "", take_over: bool = False) -> int:
        """Give the authority to a holder; its new epoch.

        Raises:
            Refusal: another one holds it and it is not taken over, or the name is empty.
        """
        self.expire(now_ns)
        if holder == NOBODY:
            raise Refusal("the authority needs a holder's name: give one")
        if self.holder not in (NOBODY, holder) and not take_over:
            raise Refusal(f"{self.who} holds the authority: wait until it is released, or take over")
        self._change(holder, operator)
        self._expires_ns = now_ns + self._duration_ns
        return self.epoch

    def covers(self, holder: str, epoch: int) -> bool:
        """Whether what a holder sends under an epoch counts now."""
        return self.holder != NOBODY and self.holder == holder and self.epoch == epoch

    def renew(self, holder: str, epoch: int, received_ns: int) -> None:
        """Prolong the lease from when its holder was heard; a stranger's renewal does nothing."""
        if self.covers(holder, epoch):
            self._renewed_ns = max(self._renewed_ns or 0, received_ns)
            self._expires_ns = max(self._expires_ns, received_ns + self._duration_ns)

    def silence_s(self, now_ns: int) -> float | None:
        """Time since the newest renewal [s]; None where there was none under this epoch."""
        return (now_ns - self._renewed_ns) / 1e9 if self._renewed_ns is not None else None

    def release(self, holder: str, epoch: int) -> None:
        """Give the authority back.

        Raises:
            Refusal: it is not this holder's, or not of this epoch.
        """
        if self.holder != holder:
            raise Refusal(f"{holder!r} does not hold the authority: {self.who or 'nobody'} does")
        self.check(epoch)
        self._change(NOBODY)

    def revoke(self) -> None:
        """Take the authority away from whoever holds it."""
        self._change(NOBODY)

    def expire(self, now_ns: int) -> None:
        """Let the lease run out where it was not renewed in time."""
        if self.holder != NOBODY and now_ns > self._expires_ns:
            self._change(NOBODY)

    def check(self, epoch: int) -> None:
        """Let a command of the present epoch pass.

        Raises:
            Refusal: nobody holds the authority, or the command is of another epoch.
        """
        if self.holder == NOBODY:
            raise Refusal("nobody holds the authority: acquire it first")
        if epoch != self.epoch:
            raise Refusal(f"the command is of epoch {epoch}, the authority of epoch {self.epoch} is {self.who}'s")

    def expires_in_s(self, now_ns: int) -> float:
        """Until the lease runs out [s]; 0 where nobody holds it."""
        return max(0, self._expires_ns - now_ns) / 1e9 if self.holder != NOBODY else 0.0

    @property
    def _duration_ns(self) -> int:
        return round(self.duration_s * 1e9)

    def _change(self, holder: str, operator: str = "") -> None:
        self.holder, self.operator = holder, operator
        self.epoch += 1
        self._renewed_ns = None
