"""A robot that stands: its processes are heard, its model answers, and nothing else of them is there."""

import threading
import time

from protocol import messages, queries, topics
from services.bus.zenoh import Lanes, ZenohBus, open_session
from services.process.clock import SystemClock, utc_ms
from tests.heartbeats import heartbeat
from tests.protocol.filled import filled
from tests.system.harness import START_S

PERIOD_S = 1.0 / topics.ROBOT_STATE.rate_hz
BEAT = round(topics.ROBOT_STATE.rate_hz / topics.HEARTBEAT.rate_hz)
AT_THE_ROBOT = ("robot", "camera", "perception", "model")


class Standing(threading.Thread):
    """A context manager.

    Args:
        endpoint: of the router.
        robot: its name.
        credentials: that may speak for every process of it; None where none are asked for.
        processes: which are there.
    """

    def __init__(self, endpoint, robot, credentials=None, processes=AT_THE_ROBOT):
        super().__init__(daemon=True)
        session = open_session(endpoint, START_S, credentials=credentials)
        lanes, clock = Lanes(session), SystemClock()
        self._buses = {name: ZenohBus(lanes, robot, name, clock) for name in processes}
        self._server = self._buses["model"].serve(queries.DESCRIBE) if "model" in processes else None
        self._end = threading.Event()
        self.probes = self._buses[processes[0]].subscribe(topics.PROBE)
        self.loads = self._buses[processes[0]].subscribe(topics.LOAD)

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self._end.set()
        self.join()
        next(iter(self._buses.values())).close()

    def run(self):
        count, due = 0, time.monotonic()
        state = filled(messages.RobotState)
        while not self._end.wait(max(0.0, due - time.monotonic())):
            due += PERIOD_S
            if "robot" in self._buses:
                self._buses["robot"].publish(topics.ROBOT_STATE, state)
            if count % BEAT == 0:
                for name, bus in self._buses.items():
                    bus.publish(topics.HEARTBEAT, heartbeat(name, utc_ms=utc_ms()))
            count += 1
            for call in self._server.take() if self._server is not None else ():
                call.reply(queries.Learnt(filled(messages.ModelState)))
