"""A stand-in for the xArm SDK's `XArmAPI`, as its documentation says it: no robot, and not the library's code.

Its joints have at once the velocity that is set, for as long as was said; it reports a hundred times a second.
"""

import threading
import time

import numpy as np


class FakeXArm:
    """One arm; made by host, as the SDK's."""

    def __init__(self):
        self.q = np.array([0.0, -0.5, 0.0, 1.2, 0.0, 1.3, 0.0])
        self.qd = np.zeros(7)
        self.until = 0.0
        self.connected = False
        self.mode, self.state, self.error_code = 0, 2, 0
        self.pulses = 850.0
        self._lock = threading.Lock()
        self._then = time.monotonic()
        self._callback = None

    def __call__(self, host):
        self.connected = True
        threading.Thread(target=self._report, daemon=True).start()
        return self

    def register_report_callback(self, callback):
        self._callback = callback
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
            self.qd, self.until = np.array(speeds), time.monotonic() + duration
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
        now = time.monotonic()
        self.q = self.q + max(0.0, min(now, self.until) - self._then) * self.qd
        self._then = now
        if now >= self.until:
            self.qd = np.zeros(7)

    def _report(self):
        while self.connected:
            with self._lock:
                self._go_on()
                report = {"joints": self.q.tolist(), "state": self.state, "error_code": self.error_code}
            callback = self._callback
            if callback is not None:
                callback(report)
            time.sleep(0.01)
