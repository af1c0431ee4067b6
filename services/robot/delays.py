"""How long what a hand does takes until the arm was told, and until it does it: measured in every control period."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np

from protocol.messages import Figure, MasterState, Mode, Phase
from services.bus.stages import Stages
from services.bus.subscription import Received
from services.robot.backends.backend import CONTROL_PERIOD
from services.robot.following import Following
from services.robot.samples import Samples
from services.robot.tick import Tick

FIGURES_KEPT = 4096


@dataclass(frozen=True)
class Applied:
    """What is told of the sample that took effect last; see `protocol.messages.RobotState`.

    Attributes:
        sequence: its number.
        latency: from its stamp to the command that it shaped [s].
        way: the part of it before the robot heard of it [s].
    """

    sequence: int = 0
    latency: float = -1.0
    way: float = -1.0


class Delays:
    """Of one robot.

    Args:
        samples: that the hand's come from.

    Attributes:
        applied: of the newest sample that took effect.
    """

    def __init__(self, samples: Samples) -> None:
        self.applied = Applied()
        self._samples = samples
        self._newest: Received[MasterState] | None = None
        self._following = Following(CONTROL_PERIOD)
        self._latencies: deque[float] = deque(maxlen=FIGURES_KEPT)
        self._ways: deque[float] = deque(maxlen=FIGURES_KEPT)

    @property
    def following_s(self) -> float:
        """See `protocol.messages.RobotState` [s]; negative where it is not known."""
        lag_s = self._following.lag_s
        return lag_s if lag_s is not None else -1.0

    @property
    def ahead_s(self) -> float | None:
        """See `protocol.messages.RobotState` [s]."""
        return self._samples.ahead_s

    def see(self, tick: Tick, mode: Mode, sample: Received[MasterState] | None, given_ns: int) -> None:
        """A control period has ended.

        Args:
            tick: what happened in it.
            mode: who shapes the motion.
            sample: that counted in it.
            given_ns: when the arm was handed its command [ns].
        """
        if tick.phase in (Phase.RAMP, Phase.EXECUTE) and not (tick.clamped or tick.fault):
            self._following.see(tick.reference.position, tick.measured.position)
        else:
            self._following.rest()
        shapes = tick.phase is Phase.EXECUTE and mode is not Mode.AUTONOMOUS
        if shapes and sample is not None and sample is not self._newest:
            self._newest = sample
            self._apply(sample, given_ns)

    def _apply(self, sample: Received[MasterState], given_ns: int) -> None:
        age_s, way_s = self._samples.age_s(sample, given_ns), self._samples.newest_way_s
        if age_s is None:
            self.applied = Applied(sample.message.sequence)
            return
        latency = max(0.0, age_s)
        way = min(latency, way_s) if way_s is not None else -1.0
        self.applied = Applied(sample.message.sequence, latency, way)
        self._latencies.append(latency)
        if way_s is not None:
            self._ways.append(way)

    def take_figures(self) -> tuple[Figure, ...]:
        """Since the last call.

        The first two count from the master's stamp on a sample to when the arm was handed the first command that the
        sample shaped, as well as the clocks can be compared.
        """
        p50, p99 = quantiles(self._latencies)
        way = quantiles(self._ways)[0] if self._ways else None
        known = Stages(way=way, apply=p50 - way if way is not None else None, motion=self._following.lag_s)
        self._latencies.clear()
        self._ways.clear()
        told = (Figure("sample_to_command_p50", 1e3 * p50, "ms"), Figure("sample_to_command_p99", 1e3 * p99, "ms"))
        return (*told, *known.figures())


def quantiles(samples: deque[int] | deque[float]) -> tuple[float, float]:
    """Median and 99th percentile; 0 where there are no samples."""
    if not samples:
        return 0.0, 0.0
    median, high = np.quantile(np.array(samples, dtype=np.float64), (0.5, 0.99))
    return float(median), float(high)
