"""The authority between two stations: this one asks for it, is asked for it, or ends whoever has it."""

from __future__ import annotations

from protocol import queries, topics
from protocol.messages import AuthorityRequest, AuthorityState
from services.bus.bus import Bus, Failed, Pending
from services.bus.identity import new_number
from services.process.schedule import Schedule
from services.station.words.heard import heard
from services.station.words.table import say

GIVE, KEEP = "give_authority", "keep_authority"
"""What who commands answers by."""

ANSWERED_WITHIN_S = 2.0

TOLD_NS = 8_000_000_000
"""For so long a person is told what was not done."""


class HandOver:
    """Says the request of this station's operator on, and the answer to another's.

    Args:
        bus: to the robot and the other stations.
        holder: this station's name.
    """

    def __init__(self, bus: Bus, holder: str) -> None:
        self._bus = bus
        self._holder = holder
        self._schedule = Schedule()
        self._told_until_ns = 0
        self._revoked: Pending[queries.Accepted] | None = None

    def ask(self, number: int, operator: str, now_ns: int) -> None:
        """Ask whoever commands, in the rhythm of the topic."""
        if self._schedule.due(topics.AUTHORITY_REQUEST, now_ns):
            request = AuthorityRequest(operator=operator, holder=self._holder, number=number)
            self._bus.publish(topics.AUTHORITY_REQUEST, request)

    def answer(self, authority: AuthorityState | None, *, give: bool) -> None:
        """Give the authority to who asks this station for it, or keep it; what is lost on the way is asked on."""
        if authority is None or not authority.asked or authority.holder != self._holder:
            return
        answer = queries.AnswerRequest(self._holder, authority.epoch, authority.asked, give, request=new_number())
        self._bus.ask(queries.ANSWER, answer, ANSWERED_WITHIN_S)

    def revoke(self, by: str, reason: str, now_ns: int) -> None:
        """End the authority of whoever commands."""
        self._told_until_ns = now_ns + TOLD_NS
        request = queries.RevokeAuthority(by, reason, request=new_number())
        self._revoked = self._bus.ask(queries.REVOKE, request, ANSWERED_WITHIN_S)

    def fault(self, now_ns: int) -> str:
        """Why the newest revocation was not done; empty where it was, is not known yet, or has been told."""
        match self._revoked.poll() if self._revoked is not None and now_ns < self._told_until_ns else None:
            case queries.Refused(reason) | Failed(reason):
                return say("event.not_revoked", why=heard(reason))
            case _:
                return ""
