# ruff: noqa: N802, PLR0917 (the library's own names)
"""A stand-in for ur_rtde's interfaces, as its documentation says them: no robot, and not the library's code.

A first-order arm follows what `servoJ` says; time is that of the clock that it is given.
"""

import time

import numpy as np

LAG_S = 0.03
FASTEST = 3.0


class FakeUr:
    """One arm; it is its own control, receive and dashboard interface."""

    def __init__(self, clock):
        self._clock = clock
        self.q = np.array([0.0, -1.9, 2.0, -1.67, -1.57, 0.0])
        self.qd = np.zeros(6)
        self.target = None
        self.protective = self.emergency = False
        self.running = False
        self.mode, self.safety = 7, 1
        self.watchdog = 0.0
        self._then = self._now

    def control(self, host):
        self.running = True
        return self

    def receive(self, host):
        return self

    def dashboard(self, host):
        return self

    # RTDEControlInterface

    def setWatchdog(self, min_frequency):
        self.watchdog = min_frequency
        return True

    def kickWatchdog(self):
        return True

    def servoJ(self, q, speed, acceleration, period, lookahead, gain):
        assert 0.03 <= lookahead <= 0.2
        assert 100.0 <= gain <= 2000.0
        self._go_on()
        if self.protective or self.emergency or not self.running:
            return False
        self.target = np.array(q)
        return True

    def servoStop(self, a):
        time.sleep(0.02)  # the library waits for the controller
        self._go_on()
        self.target = None
        return True

    def isProgramRunning(self):
        return self.running

    def reuploadScript(self):
        self.running = not (self.protective or self.emergency)
        return self.running

    def stopScript(self):
        self.running, self.target = False, None

    def disconnect(self):
        self.running = False

    # RTDEReceiveInterface

    def isConnected(self):
        return True

    def getActualQ(self):
        self._go_on()
        return self.q.tolist()

    def getActualQd(self):
        return self.qd.tolist()

    def getTimestamp(self):
        return self._now

    def getActualTCPForce(self):
        return [0.0] * 6

    def getRobotMode(self):
        return self.mode

    def getSafetyMode(self):
        return self.safety

    def isProtectiveStopped(self):
        return self.protective

    def isEmergencyStopped(self):
        return self.emergency

    # DashboardClient

    def unlockProtectiveStop(self):
        self.protective = False

    # The arm

    def tick(self):
        """A control period has passed."""

    def protect(self):
        """Its controller stops it, and ends the program."""
        self._go_on()
        self.protective, self.running, self.target = True, False, None

    @property
    def _now(self):
        return self._clock.now_ns() / 1e9

    def _go_on(self):
        now = self._now
        elapsed, self._then = now - self._then, now
        if self.target is None:
            self.qd = np.zeros(6)
        elif elapsed > 0.0:
            step = (1.0 - np.exp(-elapsed / LAG_S)) * (self.target - self.q)
            step = np.clip(step, -FASTEST * elapsed, FASTEST * elapsed)
            self.q, self.qd = self.q + step, step / elapsed
