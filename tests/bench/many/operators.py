"""Operators of robots, as small as they can be: one process stands in for the desks of all of them.

Usage: operators.py ENDPOINT ROBOT... For each robot it acquires the authority, starts refinements one after the other,
renews fifty times a second, leads with a hand that is moved a little a hundred times a second, each robot's at another
moment, and reads everything that is said of the robot, as a desk does. It says "executing" once all of them move, and
answers each line on its input with what was heard so far: messages and bytes by topic.
"""

import json
import sys
import threading
import time
from collections import Counter
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[3]))

from protocol import queries, topics
from protocol.codec import decode
from protocol.messages import AuthorityRenewal, MasterState, Mode, Phase, Prediction
from protocol.topic import VERSION
from services.bus.arrays import motion_to_wire, to_wire
from services.bus.bus import Failed
from services.bus.identity import new_number
from services.bus.zenoh import Lanes, ZenohBus, open_session, watch
from services.process.clock import SystemClock

PERSON = "bench"
HOLDER = f"station-{PERSON}"
MOTION_S = 100.0
STEPS = 75
LIFT_M = 0.03
SWAY_M, SWAY_HZ = 0.005, 0.5
LOOK_S = 0.2
ATTEMPTS = 10
START_S = 60.0


class Operator:
    """One robot's operator.

    Args:
        session: with the network.
        robot: the robot's name.
        clock: of the process.
    """

    def __init__(self, session, robot, clock):
        lanes = Lanes(session)
        self._station = ZenohBus(lanes, robot, HOLDER, clock)
        self._master = ZenohBus(lanes, robot, f"master-{PERSON}", clock)
        self._model = ZenohBus(lanes, robot, f"model-{PERSON}", clock)
        self._epoch, self._lift, self._sent = 0, LIFT_M, 0
        self._newest = None  # state of the robot, as it passed
        self.heard, self.heard_bytes = Counter(), Counter()
        watch(session, f"retouch/{VERSION}/{robot}/**", self._hear)

    def _hear(self, passing):
        name = "/".join(passing.key.split("/")[3:5])
        self.heard[name] += 1
        self.heard_bytes[name] += len(passing.payload)
        if name == topics.ROBOT_STATE.name:
            self._newest = passing.payload

    @property
    def robot(self):
        """The robot's state; None before the first."""
        return None if self._newest is None else decode(topics.ROBOT_STATE, self._newest)

    def lead(self, at):
        """One sample of the hand, and every other time a sign of life."""
        if not self._epoch:
            return
        sway = SWAY_M * np.sin(2.0 * np.pi * SWAY_HZ * at)
        state = MasterState(
            displacement=(0.0, float(sway), 0.0), engaged=True, operator=PERSON, holder=HOLDER, epoch=self._epoch
        )
        self._master.publish(topics.MASTER_STATE, state)
        self._sent += 1
        if self._sent % 2:
            renewal = AuthorityRenewal(operator=PERSON, holder=HOLDER, epoch=self._epoch)
            self._station.publish(topics.AUTHORITY_RENEWAL, renewal)

    def look(self):
        """Ask for what is missing; whether the robot executes."""
        robot = self.robot
        if robot is None:
            return False
        executes = robot.mode is Mode.REFINE and robot.phase is Phase.EXECUTE
        if executes:
            return True
        if not self._epoch or not robot.phase.running:
            self._begin(robot)
        elif robot.waiting:
            resumed = self._ask(queries.RESUME, queries.Resume(self._epoch, request=new_number()))
            if isinstance(resumed, queries.Refused):  # the authority is lost: on a busy machine it may be
                self._epoch = 0
        return False

    def _begin(self, robot):
        """Acquire the authority and start a refinement; what was refused is asked again, as a person would."""
        granted = self._ask(queries.ACQUIRE, queries.AcquireAuthority(HOLDER, PERSON))
        if not isinstance(granted, queries.AuthorityGranted):
            return
        self._epoch = granted.epoch
        prediction = self._prediction(robot.measured)
        for _ in range(ATTEMPTS):
            self._model.publish(topics.PREDICTION, prediction)
            execute = queries.Execute(self._epoch, Mode.REFINE, prediction.id, MOTION_S, request=new_number())
            if isinstance(self._ask(queries.EXECUTE, execute), queries.EpisodeStarted):
                self._lift = -self._lift
                return
            time.sleep(LOOK_S)

    def _prediction(self, start):
        positions = np.tile(start.position, (STEPS, 1))
        positions[:, -1] += np.linspace(0.0, self._lift, STEPS)
        motion = motion_to_wire(positions, np.tile(start.orientation, (STEPS, 1)), MOTION_S)
        return Prediction(
            id=new_number(),
            motion=motion,
            deviations=to_wire(np.zeros((STEPS, 3))),
            model_version=1,
            object_position=start.position,
        )

    def _ask(self, query, request):
        pending = self._station.ask(query, request)
        while (outcome := pending.poll()) is None:
            time.sleep(0.005)
        if isinstance(outcome, Failed | queries.Refused):
            print(f"{query.name}: {outcome}", file=sys.stderr, flush=True)
        return outcome


def lead(operators):
    """For ever; each robot's sample is sent at another moment of the period."""
    period_s = 1.0 / topics.MASTER_STATE.rate_hz / len(operators)
    due, turn = time.monotonic(), 0
    while True:
        operators[turn % len(operators)].lead(due)
        turn += 1
        due = max(due + period_s, time.monotonic() - period_s)
        if (left := due - time.monotonic()) > 0.0:
            time.sleep(left)


def look(operator, executing):
    """For ever; `executing` is set once the robot moves for the first time."""
    while True:
        if operator.look():
            executing.set()
        time.sleep(LOOK_S)


def main(endpoint, *robots):
    """See the module."""
    sys.setswitchinterval(5e-4)
    clock = SystemClock()
    session = open_session(endpoint, START_S)
    operators = [Operator(session, robot, clock) for robot in robots]
    threading.Thread(target=lead, args=(operators,), daemon=True).start()
    executing = [threading.Event() for _ in operators]
    for operator, event in zip(operators, executing, strict=True):
        threading.Thread(target=look, args=(operator, event), daemon=True).start()
    for event in executing:
        event.wait()
    print("executing", flush=True)
    for _ in sys.stdin:
        messages, sizes = Counter(), Counter()
        for operator in operators:
            messages.update(operator.heard.copy())
            sizes.update(operator.heard_bytes.copy())
        print(json.dumps({name: (messages[name], sizes[name]) for name in messages}), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
