"""A stand-in for the xArm SDK's `XArmAPI`, as its documentation says it: no robot, and not the library's code.

Its joints have at once the velocity that is set, for as long as was said; it reports whenever it is told that a
control period has passed.
"""

import threading
import time

import numpy as np


class FakeXArm:
    """One arm; made by host, as the SDK's."""

    def __init__(self, clock):
        self._clock = clock
        self.q = np.array([0.0, -0.5, 0.0, 1.2, 0.0, 1.3, 0.0])
        self.qd = np.zeros(7)
        self.until = 0.0
        self.connected = False
        self.mode, self.state, self.error_code = 0, 2, 0
        self.pulses = 850.0
        self._lock = threading.Lock()
        self._then = self._now
        self._callback = None

    def __call__(self, host):
        self.connected = True
        return self

    def register_report_callback(self, callback):
        self._callback = callback
        self.tick()
        return True

    def disconnect(self):
        self.connected, self._callback = False, None

    def motion_enable(self, enable):
        return 0

    def set_mode(self, mode):
        self.mode = mode
        return 0

    def set_state(self, state):
        if self.error_code:
            return 1
        self.state = 4 if state == 4 else 2
        self.tick()
        return 0

    def clean_error(self):
        self.error_code = 0
        return 0

    def clean_warn(self):
        return 0

    def vc_set_joint_velocity(self, speeds, is_radian, is_sync, duration):
        assert is_radian
        time.sleep(0.002)  # the SDK waits for the answer
        if self.mode != 4 or self.state in (4, 5):
            return 9
        with self._lock:
            self._go_on()
            self.qd, self.until = np.array(speeds), self._now + duration
        return 0

    def get_gripper_position(self):
        return 0, self.pulses

    def set_gripper_position(self, pos, wait):
        self.pulses = pos
        return 0

    def collide(self):
        """Its controller stops it."""
        with self._lock:
            self._go_on()
            self.qd, self.error_code, self.state = np.zeros(7), 31, 4

    def _go_on(self):
        now = self._now
        self.q = self.q + max(0.0, min(now, self.until) - self._then) * self.qd
        self._then = now
        if now >= self.until:
            self.qd = np.zeros(7)

    @property
    def _now(self):
        return self._clock.now_ns() / 1e9

    def tick(self):
        """A control period has passed: the arm reports."""
        with self._lock:
            self._go_on()
            report = {"joints": self.q.tolist(), "state": self.state, "error_code": self.error_code}
        if self._callback is not None:
            self._callback(report)
