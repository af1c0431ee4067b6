"""What a run over a bad network was like, from what was heard at both its ends."""

from dataclasses import dataclass

import numpy as np

from protocol import topics
from protocol.codec import decode
from protocol.messages import Mode, Phase
from tests.cameras import HEAD_IMAGE, WRIST_IMAGE
from tests.network.link import AHEAD_S

PICTURES = (HEAD_IMAGE, WRIST_IMAGE)
SETTLED_S = 0.3
"""A robot that began to hold stands after so long."""

SMOOTHED = 21
"""Control periods over which a path is a parabola in time, nearly; shorter ones are rounding of the measurement."""


@dataclass(frozen=True)
class Figures:
    """Of one run.

    Attributes:
        up_ms: median and 99th percentile of the master's samples on their way to the robot.
        told_ms: the same as `up_ms`, as the robot tells it, which sees neither clock but its own.
        down_ms: the same, of the robot's states on their way to the desk.
        held: share of the refinements' time in which the robot held.
        hold_after_ms: from the last sample that took effect to the hold, at most.
        oldest_ms: age of a sample when it shaped a command, at most.
        jerk: of the refinements' paths, root of the mean square [m/s^3].
        unasked_mm: how far the robot moved in a hold, at most.
        pictures_hz: of both cameras together at the desk, those that could be shown.
        pictures_ms: median and 99th percentile of their age there.
    """

    up_ms: tuple[float, float]
    told_ms: tuple[float, float]
    down_ms: tuple[float, float]
    held: float
    hold_after_ms: float
    oldest_ms: float
    jerk: float
    unasked_mm: float
    pictures_hz: float
    pictures_ms: tuple[float, float]


class Record:
    """A run as it was heard.

    Args:
        near: what came at the robot's site: when [ns], the topic's name, the message.
        far: the same at the desk, by the desk's clock.
    """

    def __init__(self, near, far):
        ahead = AHEAD_S * 1_000_000_000
        self.states = [state for _, state in _of(near, topics.ROBOT_STATE)]
        heard = list(_of(near, topics.MASTER_STATE))
        self._sent = _Samples((sample, sample.stamp_ns - ahead) for _, sample in heard)
        self._came = _Samples((sample, at) for at, sample in heard)
        self._up = np.array([at - sample.stamp_ns + ahead for at, sample in heard]) / 1e6
        self._down = np.array([at - ahead - state.stamp_ns for at, state in _of(far, topics.WORLD_STATE)]) / 1e6
        shown = [(at - ahead, at - ahead - image.captured_ns) for topic in PICTURES for at, image in _shown(far, topic)]
        self._shown = np.array(shown).reshape(-1, 2)

    def figures(self):
        """See `Figures`."""
        refining = [state for state in self.states if state.mode is Mode.REFINE and state.phase.running]
        held = [state for state in refining if state.phase is Phase.HOLD]
        seconds = np.ptp(self._shown[:, 0]) / 1e9 if len(self._shown) else np.inf
        return Figures(
            up_ms=_quantiles(self._up),
            told_ms=_quantiles([1e3 * state.applied_way for state in refining if state.applied_way >= 0.0]),
            down_ms=_quantiles(self._down),
            held=len(held) / len(refining) if refining else np.nan,
            hold_after_ms=max(self._hold_delays(), default=0.0),
            oldest_ms=max(self._applied_ages(refining), default=np.nan),
            jerk=self._jerk(refining),
            unasked_mm=1e3 * max(self._drifts(), default=0.0),
            pictures_hz=len(self._shown) / seconds,
            pictures_ms=_quantiles(self._shown[:, 1] / 1e6),
        )

    def moved_between(self, began_ns, ended_ns):
        """How far the robot came in a time, at most [m]."""
        positions = np.array(
            [state.measured.position for state in self.states if began_ns <= state.stamp_ns <= ended_ns]
        )
        return float(np.linalg.norm(positions - positions[0], axis=1).max()) if len(positions) else 0.0

    def _applied_ages(self, refining):
        """Of the sample behind each command of a refinement [ms]."""
        for state in refining:
            sent = self._sent.newest(state.applied_sequence, state.stamp_ns)
            if state.phase is Phase.EXECUTE and sent is not None:
                yield (state.stamp_ns - sent) / 1e6

    def _hold_delays(self):
        """From the coming of the last sample that took effect to each hold of a refinement [ms]."""
        for before, after in zip(self.states, self.states[1:], strict=False):
            begins = before.phase is Phase.EXECUTE and after.phase is Phase.HOLD
            came = self._came.newest(before.applied_sequence, before.stamp_ns)
            if begins and after.mode is Mode.REFINE and came is not None:
                yield (after.stamp_ns - came) / 1e6

    def _drifts(self):
        """How far it moved in each hold, once it had settled [m]."""
        began_ns, episode = None, 0
        for state in self.states:
            if state.phase is not Phase.HOLD:
                began_ns = None
                continue
            if began_ns is None or state.episode != episode:
                began_ns, start, episode = state.stamp_ns, None, state.episode
            if state.stamp_ns - began_ns > SETTLED_S * 1e9:
                start = state.measured.position if start is None else start
                yield float(np.linalg.norm(np.subtract(state.measured.position, start)))

    def _jerk(self, refining):
        """Root of the mean square over all refinements' paths, holds included [m/s^3]."""
        squares = []
        for episode in {state.episode for state in refining}:
            path = [state for state in refining if state.episode == episode]
            squares.extend(_squared_jerk(np.array([state.reference.position for state in path])))
        return float(np.sqrt(np.mean(squares))) if squares else np.nan


class _Samples:
    """When something happened to each of a hand's samples [ns]; another process counts them from the first again.

    Args:
        known: samples, and when it happened; what comes twice happened when it came first.
    """

    def __init__(self, known):
        self._known = {}
        for sample, at_ns in known:
            self._known.setdefault(sample.sequence, {}).setdefault(sample.publisher, at_ns)

    def newest(self, sequence, now_ns):
        """Of the newest sample of the number, as it was then; None where there was none."""
        return max((at for at in self._known.get(sequence, {}).values() if at <= now_ns), default=None)


def _of(heard, topic):
    """One topic's messages, and when each came [ns]."""
    return ((at, decode(topic, raw)) for at, name, raw in heard if name == topic.name)


def _shown(heard, topic):
    """The pictures of a camera that need none that is missing, and when each came [ns]."""
    before = None
    for at, image in _of(heard, topic):
        follows = before is not None and (image.sequence, image.after_key) == (
            before.sequence + 1,
            before.after_key + 1,
        )
        if image.after_key == 0 or follows:
            before = image
            yield at, image


def _squared_jerk(path):
    """Of a path that is sampled once a control period, shape (n, 3)."""
    if len(path) <= SMOOTHED:
        return []
    times = (np.arange(SMOOTHED) - SMOOTHED // 2) / topics.ROBOT_STATE.rate_hz
    weights = np.linalg.pinv(np.vander(times, 4, increasing=True))[3] * 6.0
    jerk = np.stack([np.convolve(axis, weights[::-1], "valid") for axis in path.T], axis=1)
    return np.sum(jerk**2, axis=1)


def _quantiles(samples):
    return tuple(np.quantile(samples, (0.5, 0.99)).tolist()) if len(samples) else (np.nan, np.nan)
