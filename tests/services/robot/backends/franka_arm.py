"""A simulated Franka in a process of its own, that speaks the vendor's protocol on loopback; and what is seen there.

As a program: `python franka_arm.py Q1 ... Q7` prints its address, then a hundred times a second its own time since its
start and the joints' positions, until it is terminated.
"""

import logging
import signal
import subprocess
import sys
import threading
import time

import numpy as np

PATIENCE_S = 30.0
WINDOW_S = 0.05
STANDING = 0.001  # [rad]


class FrankaArm:
    """The process, seen from a test."""

    def __init__(self, q=()):
        command = [sys.executable, __file__, *map(str, q)]
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        self.host = self._process.stdout.readline().strip()
        self._rows = []
        self._reader = threading.Thread(target=self._listen, daemon=True)
        self._reader.start()
        self.await_state()

    def await_state(self):
        until = time.monotonic() + PATIENCE_S
        while not self._rows:
            assert self._process.poll() is None, "the simulated Franka has ended"
            assert time.monotonic() < until
            time.sleep(0.02)

    @property
    def seen(self):
        """What it has printed, a row each: its own time [s], positions [rad]."""
        return np.array(self._rows)

    @property
    def now(self):
        """Its own time [s]."""
        return self._rows[-1][0]

    def stood_after(self, since):
        """How long after `since`, in its own time, no joint moved by more than a milliradian in 50 ms any more [s]."""
        rows = self.seen
        times, q = rows[:, 0], rows[:, 1:]
        for i in np.flatnonzero(times >= since):
            later = q[(times >= times[i]) & (times <= times[i] + WINDOW_S)]
            if times[-1] >= times[i] + WINDOW_S and np.ptp(later, axis=0).max() < STANDING:
                return times[i] - since
        return np.inf

    def rest(self, seconds):
        """Wait until so much of its own time has passed, which on a busy machine goes slower than the clock's."""
        due = self.now + seconds
        until = time.monotonic() + PATIENCE_S
        while self.now < due:
            assert time.monotonic() < until
            time.sleep(0.005)

    def freeze(self):
        self._process.send_signal(signal.SIGSTOP)

    def thaw(self):
        self._process.send_signal(signal.SIGCONT)

    def close(self):
        self._process.kill()
        self._process.wait()
        self._reader.join()
        self._process.stdout.close()

    def _listen(self):
        for line in self._process.stdout:
            self._rows.append([float(value) for value in line.split()])


def main():
    from franky_sim import SimulationServer
    from franky_sim.mujoco_simulator import MujocoSimulator

    logging.disable()
    q = [float(value) for value in sys.argv[1:]]
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(0))
    with MujocoSimulator(enable_visualization=False) as sim:
        arm = sim.add_robot(initial_q=q) if q else sim.add_robot()
        with SimulationServer(sim) as server:
            server.run_async()
            sys.stdout.write(f"{arm.hostname}\n")
            while True:
                state = arm.inner_state
                row = (sim.data.time, *state.q)
                sys.stdout.write(f"{' '.join(map(str, row))}\n")
                sys.stdout.flush()
                time.sleep(0.01)


if __name__ == "__main__":
    main()
