"""What the robot is asked for: each request is carried out, or refused in one line that says why."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import TypeVar

from protocol import queries
from protocol.names import person
from protocol.queries import (
    Accepted,
    AnswerRequest,
    AuthorityGranted,
    EpisodeStarted,
    Execute,
    Finish,
    Pace,
    Refused,
    ReleaseAuthority,
    ReleaseStop,
    Reset,
    Resume,
    RevokeAuthority,
    Teleoperate,
)
from services.bus.bus import Bus, Rep, Req
from services.bus.predictions import Predictions
from services.bus.server import Server
from services.process.lines import one_line
from services.robot.control import Control
from services.robot.evidence import Evidence
from services.robot.refusal import Refusal

log = logging.getLogger(__name__)

Commanding = TypeVar("Commanding", AnswerRequest, ReleaseAuthority, Finish, Pace, Resume, Reset)
"""What only who has the authority asks for."""


class Requests:
    """Answers everything that the robot is asked.

    Attributes:
        refused: requests so far.

    Args:
        bus: to answer on.
        control: that carries it out.
        evidence: that it was.
        proven: the network shows who somebody is.
    """

    def __init__(self, bus: Bus, control: Control, evidence: Evidence, *, proven: bool) -> None:
        self.refused = 0
        self._control = control
        self._evidence = evidence
        self._proven = proven
        self._predictions = Predictions(bus)
        self._acquire = bus.serve(queries.ACQUIRE)
        self._authority_answer = bus.serve(queries.ANSWER)
        self._revoke = bus.serve(queries.REVOKE)
        self._release = bus.serve(queries.RELEASE)
        self._execute = bus.serve(queries.EXECUTE)
        self._teleoperate = bus.serve(queries.TELEOPERATE)
        self._finish = bus.serve(queries.FINISH)
        self._pace = bus.serve(queries.PACE)
        self._resume = bus.serve(queries.RESUME)
        self._reset = bus.serve(queries.RESET)
        self._release_stop = bus.serve(queries.RELEASE_STOP)

    def answer(self, now_ns: int) -> None:
        """Carry out, or refuse in one line, what came since the last call."""
        control = self._control
        lease = control.lease
        lease_s = lease.duration_s
        self._answer(self._acquire, lambda request, by: AuthorityGranted(control.acquire(request, by, now_ns), lease_s))
        self._answer(self._authority_answer, self._commanded(lambda request: lease.answer(request, now_ns)))
        self._answer(self._revoke, self._revoked)
        self._answer(self._release, self._commanded(lease.release))
        self._answer(self._execute, self._executed)
        self._answer(self._teleoperate, self._teleoperated)
        self._answer(self._finish, self._commanded(control.finish))
        self._answer(self._pace, self._commanded(control.pace))
        self._answer(self._resume, self._commanded(control.resume))
        self._answer(self._reset, self._commanded(control.reset))
        self._answer(self._release_stop, self._released)

    def _executed(self, request: Execute, asker: str) -> EpisodeStarted:
        self._control.lease.check_sender(request.epoch, asker)
        predicted = self._predictions.find(request.prediction)
        started = EpisodeStarted(self._control.execute(request, predicted))
        self._evidence.set_in_motion(predicted)
        return started

    def _teleoperated(self, request: Teleoperate, asker: str) -> EpisodeStarted:
        self._control.lease.check_sender(request.epoch, asker)
        started = EpisodeStarted(self._control.teleoperate(request))
        self._evidence.set_in_motion(None)
        return started

    def _revoked(self, request: RevokeAuthority, asker: str) -> Accepted:
        if self._proven and request.by != person(asker):
            raise Refusal(f"{asker!r} cannot revoke in the name of {request.by!r}: a supervisor does in their own")
        self._control.lease.revoke(request)
        return Accepted()

    def _released(self, request: ReleaseStop, asker: str) -> Accepted:
        del asker
        self._control.release_stop(request)
        return Accepted()

    def _commanded(self, carry_out: Callable[[Commanding], None]) -> Callable[[Commanding, str], Accepted]:
        """What carries out a command of whoever has the authority, and of nobody else."""

        def answer(request: Commanding, asker: str) -> Accepted:
            self._control.lease.check_sender(request.epoch, asker)
            carry_out(request)
            return Accepted()

        return answer

    def _answer(self, server: Server[Req, Rep], answer: Callable[[Req, str], Rep]) -> None:
        for call in server.take():
            reply: Rep | Refused
            try:
                reply = answer(call.request, call.asker)
                self._evidence.commanded(call.request, call.asker)
            except Refusal as refusal:
                reply = self._refuse(refusal.reason, lasting=refusal.lasting)
            except Exception as error:
                # Nothing that a client sends may end the robot's process.
                log.debug("as raised", exc_info=error)
                reply = self._refuse(f"the robot failed at this request ({type(error).__name__}: {error})")
            call.reply(reply)

    def _refuse(self, reason: str, *, lasting: bool = False) -> Refused:
        self.refused += 1
        line = one_line(reason)
        log.warning("refused: %s", line)
        return Refused(line, lasting)
