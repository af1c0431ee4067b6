"""A supervised run whose processes are killed, and what its witness sees of that."""

import time

import numpy as np

from protocol.messages import Phase
from tests.system.harness import POLL_S

BACK_S = 30.0
EPISODE_S = 90.0
HOLD_S = 10.0
STILL_M = 1e-3
STILL_SAMPLES = 30


class Run:
    """A supervised run, and what its witness sees."""

    def __init__(self, up, witness):
        self.up = up
        self.witness = witness

    def kill(self, name):
        """kill -9; returns the process id that it had."""
        return self.up.kill(name)

    def back(self, name, pid):
        """Wait until the process lives again, as another one, and speaks."""
        self.up.until(lambda: self.up.pids().get(name, pid) != pid, BACK_S, f"{name} starts again")
        if name != "router":
            self.up.until(
                lambda: (beat := self.witness.beats().get(name)) and beat.pid == self.up.pids().get(name),
                BACK_S,
                f"{name} speaks again",
            )

    def executing(self, mode):
        """Wait until an episode of this mode is under way."""

        def seen():
            robot = self.witness.robot
            return robot and robot.phase is Phase.EXECUTE and robot.mode is mode and 0.05 < robot.progress < 0.7

        self.up.until(seen, EPISODE_S, f"the robot executes: {mode.value}")

    def holds(self, reason):
        """Wait until the robot holds for this reason, and see that the measured pose stands still meanwhile."""

        def holding(robot):
            return robot.phase is Phase.HOLD and reason in robot.hold_reason

        self.up.until(lambda: (robot := self.witness.robot) and holding(robot), HOLD_S, f"the robot holds: {reason}")
        positions = {}
        deadline = time.monotonic() + 5.0
        while len(positions) < STILL_SAMPLES and time.monotonic() < deadline:
            robot = self.witness.robot
            if robot and not holding(robot):
                break
            if robot:
                positions[robot.sequence] = robot.measured.position
            time.sleep(POLL_S)
        # The arm comes to rest in the first of them.
        still = np.array(list(positions.values()))[STILL_SAMPLES // 3 :]
        assert len(still) > 5, f"held for {len(positions)} states only"
        assert np.ptp(still, axis=0).max() < STILL_M
