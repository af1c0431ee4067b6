"""Predictions as the model announces them, for services that are tested without a model."""

from itertools import count

import numpy as np

from protocol.messages import Prediction
from protocol.topics import PREDICTION
from services.bus.arrays import to_wire

_IDS = count(1)


def prediction(motion, identity=None):
    """A prediction of a motion, under an id of its own by default."""
    return Prediction(
        id=next(_IDS) if identity is None else identity,
        motion=motion,
        deviations=to_wire(np.zeros(motion.positions.shape)),
        model_version=1,
        object_position=(0.0, 0.0, 0.0),
    )


def announce(bus, motion, identity=None):
    """Announce a prediction of the motion; its id."""
    announced = prediction(motion, identity)
    bus.publish(PREDICTION, announced)
    return announced.id
