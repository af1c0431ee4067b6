"""The master that a hand leads through devices of the operator's page: whichever of them it uses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from protocol.messages import Figure, OperatorInput, Phase, RobotState, Trouble, Vector3
from services.master.devices.device import ZERO, Episode, Moment, Sample
from services.master.devices.hand import Hand, Source
from services.master.devices.lever import Law, Lever, TurnLever, turned
from services.process.master_devices import Led

NOBODY = OperatorInput()

_UNDER_WAY = (Phase.EXECUTE, Phase.HOLD)


class _Trouble(NamedTuple):
    """What is wrong, and with which device."""

    kind: Trouble
    device: str


NO_TROUBLE = _Trouble(Trouble.NONE, "")


class LedMaster:
    """Turns what a hand does into a displacement and a rotation.

    Where the hand leads the robot without a prediction nothing decays: what was moved stays, as far as it goes, and
    only what changes counts; a pen that is lifted decouples.

    A device counts only while an episode is led or refined and the page's newest state is fresh and focused. Otherwise
    nobody is at it: it disengages at once, and both fall to zero within `lever.LET_GO_S`. Whoever engages it takes over
    the correction as the robot applies it then: a held robot does not jump back because its operator, or this process,
    was away. While the robot does not execute yet, on its way to the start or held, the device follows the correction
    that it applies.

    A hand pushes along its operator's axes, which may be turned about the base's z axis, see `OperatorInput.yaw`: they
    turn once everything was let go, and what stands then stays where it is.

    Of several devices that is in use which a hand used last. A device counts once it was seen at rest: what is held
    on the way to the start, what was plugged in deflected, or a stick that drifts asks for nothing. Two devices that
    are used at once, and one that is pulled out while it is in use, disengage. What was held all through a hold that
    ends by itself, because something came late for a moment, goes on; it does nothing meanwhile.

    Args:
        law: growth, decay and reach of both.
        sources: of what hands do; the first one's device is in use until another is used.
    """

    def __init__(self, law: Led, sources: Sequence[Source]) -> None:
        self._push = Lever(Law(law.growth, law.decay, law.reach))
        self._turn = TurnLever(Law(law.turn_growth, law.turn_decay, law.turn_reach))
        self._sources = sources
        self._yaw = 0.0
        self._engaged = False
        self._rested: set[str] = set()
        self._episode: Episode | None = None
        self._quarrel: set[str] = set()
        self._met: set[str] = set()
        self.name = sources[0].kind

    def step(self, moment: Moment) -> Sample:
        """Advance by the time that has passed."""
        robot = moment.teaching or moment.refining
        hands = self._look(moment.operator)
        trouble = self._choose(hands, robot) if _is_at(moment.operator) else NO_TROUBLE
        self._turn_axes(hands, moment.operator)
        hand = hands.get(self.name)
        if hand is not None and (not hand.coupled or trouble.kind is Trouble.TWO):
            hand = None
        sample = self._teach(robot, hand, moment.dt) if moment.teaching else self._refine(robot, hand, moment.dt)
        if not self._goes_on(moment, sample):
            self._rested.clear()
        self._rested |= {name for name, one in hands.items() if not one.held}
        actions = tuple(sorted({action for one in hands.values() for action in one.actions}))
        return replace(sample, actions=actions, trouble=trouble.kind, trouble_with=trouble.device)

    def figures(self) -> tuple[Figure, ...]:
        """What the page reads is measured by the page."""
        return ()

    def close(self) -> None:
        """Let go of what is read here."""
        for source in self._sources:
            source.close()

    def _look(self, operator: OperatorInput | None) -> dict[str, Hand]:
        if operator is None or not operator.focused:
            operator = NOBODY  # what was dragged meanwhile was not dragged for the robot
        hands = {name: hand for source in self._sources for name, hand in source.look(operator).items()}
        return hands if operator is not NOBODY else {}

    def _choose(self, hands: Mapping[str, Hand], robot: RobotState | None) -> _Trouble:
        """Settle which device is in use; what is wrong, and with which."""
        self._rested &= hands.keys()
        held = {name for name, hand in hands.items() if hand.held}
        used = held & self._rested
        self._quarrel &= held
        if len(self._quarrel) < 2:
            self._quarrel = used if len(used) > 1 else set()
        if self._quarrel:
            return _Trouble(Trouble.TWO, " and ".join(sorted(self._quarrel)))
        self.name = next(iter(used), self.name)
        if self.name not in self._met or (robot is None and self.name not in hands):
            self.name = next(iter(hands), self.name)  # between two episodes nothing is lost with a device
        self._met |= hands.keys()
        if self.name not in hands:
            return _Trouble(Trouble.GONE if self.name in self._met else Trouble.ABSENT, self.name)
        restless = sorted(held - used) if _executes(robot) else ()
        return _Trouble(Trouble.NOT_AT_REST, restless[0]) if restless else NO_TROUBLE

    def _goes_on(self, moment: Moment, sample: Sample) -> bool:
        """What was seen at rest has been so since: the hand is there, or was a moment ago as far as anybody knows.

        Whether a hold is short is the robot's to say: it waits to be asked after one that was not.
        """
        operator, robot = moment.operator, moment.robot
        heard = operator is not None and not operator.late
        if heard and not _is_at(operator):
            return False
        if robot is None:
            return True
        before, self._episode = self._episode, (robot.publisher, robot.episode)
        if before != self._episode or robot.phase not in _UNDER_WAY or robot.waiting:
            return False
        return sample.engaged or not heard

    def _turn_axes(self, hands: Mapping[str, Hand], operator: OperatorInput | None) -> None:
        if operator is None or not operator.focused or any(hand.held for hand in hands.values()):
            return
        for lever in (self._push, self._turn):
            lever.turn_axes(operator.yaw - self._yaw)
        self._yaw = operator.yaw

    def _refine(self, robot: RobotState | None, hand: Hand | None, dt: float) -> Sample:
        """What the hand adds to a prediction: it returns to nothing where the hand does nothing."""
        if robot is None or hand is None:
            return self._let_go(dt)
        if not self._engaged or robot.phase is not Phase.EXECUTE:
            return self._follow(robot)
        before, counts = self._push.value, self._rested_hand(hand)
        if counts.grips:
            self._push.drag(counts.drag)
            self._turn.drag(counts.twist)
        else:
            self._push.push(counts.push, dt)
            self._turn.push(counts.turn, dt)
        return self._sample(before, dt)

    def _teach(self, robot: RobotState | None, hand: Hand | None, dt: float) -> Sample:
        """Where the hand leads alone: what it moved stays, as far as it goes, and only what changes counts."""
        before = self._push.value
        if hand is None or hand.lifted:
            self._engaged = False
        elif self._engaged and _executes(robot):
            counts = self._rested_hand(hand)
            self._push.lead(counts.push, counts.drag, dt)
            self._turn.lead(counts.turn, counts.twist, dt)
        else:
            self._engaged = True
        return self._sample(before, dt)

    def _rested_hand(self, hand: Hand) -> Hand:
        """The hand, or one that does nothing until the device was seen at rest."""
        return hand if self.name in self._rested else Hand()

    def _follow(self, robot: RobotState) -> Sample:
        """Stand where the correction is that the robot applies, whatever is held."""
        x, y, z = robot.offset
        applied = (x / robot.master_gain, y / robot.master_gain, z / robot.master_gain)
        self._push.take_over(turned(applied, -self._yaw))
        self._turn.take_over(turned(robot.turn, -self._yaw))
        self._engaged = True
        return self._sample(self._push.value, 0.0)

    def _let_go(self, dt: float) -> Sample:
        self._engaged = False
        before = self._push.value
        self._push.let_go(dt)
        self._turn.let_go(dt)
        return self._sample(before, dt)

    def _sample(self, before: Vector3, dt: float) -> Sample:
        """What is told, in base axes; `before` is where the hand's own axes had it before dt [m]."""
        velocity = _velocity(before, self._push.value, dt)
        displacement, velocity, rotation = (
            turned(vector, self._yaw) for vector in (self._push.value, velocity, self._turn.value)
        )
        return Sample(displacement, velocity, rotation, engaged=self._engaged, yaw=self._yaw)


def _is_at(operator: OperatorInput | None) -> bool:
    return operator is not None and operator.focused


def _executes(robot: RobotState | None) -> bool:
    return robot is not None and robot.phase is Phase.EXECUTE


def _velocity(before: Vector3, after: Vector3, dt: float) -> Vector3:
    if dt <= 0.0:
        return ZERO
    return (after[0] - before[0]) / dt, (after[1] - before[1]) / dt, (after[2] - before[2]) / dt
