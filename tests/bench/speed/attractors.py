"""Dynamic movement primitives of one motion of 100 steps: fit, and reproduction to another goal."""

import numpy as np

from lfd.models.dmp import DMP
from tests.bench.speed.peers import peer
from tests.bench.speed.primitives import STEPS, demonstrations
from tests.bench.support.timing import Contender, compare

COUNT = 100  # basis functions, as `lfd.models.dmp` takes


def measure(rng, effort):
    motion = demonstrations(rng, 1)[0].trajectory
    learnt = DMP.fit(motion)
    start = motion.positions[0], motion.orientations[0]
    goal = motion.positions[-1] + [0.0, 0.05, 0.0], motion.orientations[-1]
    theirs = peer(
        "movement_primitives", "movement_primitives.dmp", lambda module: _library(module, motion, goal), effort
    )
    fit = [
        Contender("retouch, pose", lambda: DMP.fit(motion)),
        *(c for c in theirs if "open_loop" not in c.name),
    ]
    reproduce = [
        Contender("retouch, pose", lambda: learnt.reproduce(start, goal, motion.duration, STEPS)),
        *(c for c in theirs if "imitate" not in c.name),
    ]
    return [
        *compare(f"dynamic primitive, fit, {STEPS} steps, {COUNT} functions", fit, effort),
        *compare(f"dynamic primitive, reproduce, {STEPS} steps, {COUNT} functions", reproduce, effort),
    ]


def _library(module, motion, goal):
    T = np.linspace(0.0, motion.duration, STEPS)
    poses = np.hstack([motion.positions, motion.orientations])
    options = {"execution_time": motion.duration, "dt": motion.duration / (STEPS - 1), "n_weights_per_dim": COUNT}

    def imitated(make):
        primitive = make()
        primitive.imitate(T, poses)
        return primitive

    def contenders(name, make):
        learnt = imitated(make)
        learnt.configure(start_y=poses[0], goal_y=np.concatenate(goal))
        return [
            Contender(f"movement_primitives, {name}, imitate", lambda: imitated(make)),
            Contender(f"movement_primitives, {name}, open_loop", learnt.open_loop),
        ]

    return [
        *contenders("CartesianDMP (pose)", lambda: module.CartesianDMP(**options)),
        *contenders("DMP (7 separate numbers)", lambda: module.DMP(n_dims=7, **options)),
    ]
