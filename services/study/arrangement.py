"""What the robot finds in a study: the same in every part, whoever takes part."""

from __future__ import annotations

import numpy as np

from services.offline.result import Arrangement
from services.study.protocol.protocol import Protocol
from sim.tasks import AnyScene


def arrangement(protocol: Protocol, scene: AnyScene) -> Arrangement:
    """Of the target and of what stands around it.

    Raises:
        UnknownVariant: the scene has no such arrangement.
        OutOfReach: no target of it can be there.
    """
    task = protocol.task
    place = task.object_position or tuple(scene.region.sample(np.random.default_rng((protocol.order.seed, 5))).tolist())
    variant = task.variant or scene.variants[-1]
    scene.check(variant)
    scene.check_place(np.array(place), scene.margin)
    return Arrangement.of(variant, place, has_object=scene.has_object)
