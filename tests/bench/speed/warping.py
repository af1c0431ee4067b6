"""Exact dynamic time warping with its path, 7-D Euclidean, against the libraries that do it."""

from importlib import import_module

import numpy as np

from lfd.motion import dtw as module
from lfd.motion.dtw import dtw
from tests.bench.speed.peers import peer
from tests.bench.support.timing import Contender, compare

D = 7
GOALS = {75: 0.1, 780: 6.0, 5000: 200.0}  # [ms]


def measure(rng, effort):
    dtw(np.zeros((1000, 1)), np.zeros((1000, 1)))  # a long one loads Numba; from then on it serves the short ones too
    results = []
    for n in GOALS if effort.large else (75, 300):
        a, b = motion(rng, n), motion(rng, n)
        results += compare(f"time warping with path, n = {n}", _contenders(a, b, GOALS.get(n), effort), effort)
    return results


def motion(rng, n):
    """A motion (n, 7) along one path, with a little noise, in a tempo of its own and with a pause."""
    tempo = np.repeat(rng.uniform(0.2, 2.0, 10), -(-n // 10))[:n]
    pause = rng.integers(n // 4, n // 2)
    tempo[pause : pause + n // 8] = 0.0
    t = tempo.cumsum()[:, None] / tempo.sum()
    waves = np.sin(2.0 * np.pi * np.linspace(0.5, 3.0, D) * t)
    return waves + 0.05 * rng.normal(size=(n, D)).cumsum(axis=0) / np.sqrt(n)


def _contenders(a, b, goal, effort):
    exact = dtw(a, b).distance
    by_numpy = module._NUMPY_ROUTE

    def without_numba():
        distance, steps = by_numpy.accumulate(a, np.array(b.T, order="C"))
        return distance, by_numpy.trace(steps)

    def error(distance):
        percent = round(100.0 * (distance / exact - 1.0), 9) + 0.0  # no -0
        return f"distance error {percent:.3g} %"

    def along(path):
        i, j = np.array(path).T
        return np.linalg.norm(a[i] - b[j], axis=1).sum()

    def fast(library):
        def run():
            return library.fastdtw(a, b, radius=1, dist=2)

        return [Contender("fastdtw, radius 1", run, note=error(run()[0]))]

    def dtai(library):
        import_module("dtaidistance.dtw_cc")  # its loops in C, without which it would be another contender

        def distance():
            return library.distance_fast(a, b, inner_dist="euclidean")

        def path():
            return library.warping_path(a, b, use_c=True, inner_dist="euclidean")

        return [
            Contender("dtaidistance, C, distance without path", distance, note=error(distance())),
            Contender("dtaidistance, C, path", path, note=f"{error(along(path()))}, along its path"),
        ]

    def tslearn(library):
        def run():
            return library.dtw_path_from_metric(a, b, metric="euclidean")

        return [Contender("tslearn", run, note=error(run()[1]))]

    ours = "retouch" if module._compiled_route() is not by_numpy else "retouch (Numba is not installed)"
    return [
        Contender(ours, lambda: dtw(a, b), goal),
        Contender("retouch, NumPy", without_numba, note=error(without_numba()[0])),
        *peer("fastdtw", "fastdtw", fast, effort),
        *peer("dtaidistance", "dtaidistance.dtw_ndim", dtai, effort),
        *peer("tslearn", "tslearn.metrics", tslearn, effort),
    ]
