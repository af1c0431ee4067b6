"""The model process' shell: answers queries from a store on disk and a model in memory."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np

from lfd.exceptions import LfdError
from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.model import MovementModel
from lfd.models.promp import ConditionedProMP
from lfd.motion.demonstration import Demonstration, Situation
from lfd.motion.refinement import refine
from lfd.motion.trajectory import Trajectory
from lfd.store.database import DemonstrationStore, StoredDemonstration
from lfd.store.database import Kind as StoredKind
from protocol import messages, queries, topics
from protocol.queries import AddDemonstration, Predict, Predicted, Refused
from services.bus.arrays import motion_from_wire, motion_to_wire, to_wire
from services.bus.bus import Bus, Rep, Req, Server
from services.bus.identity import new_number
from services.process.clock import Clock
from services.process.config import Configuration, ModelSection
from services.process.exceptions import ServiceError

log = logging.getLogger(__name__)

MODELS: dict[str, type[AdaptiveProMP] | type[ConditionedProMP]] = {
    "adaptive": AdaptiveProMP,
    "promp": ConditionedProMP,
}


def database_path(section: ModelSection, robot: str) -> Path:
    """Where the demonstrations lie: as configured, or in the user's data folder."""
    if section.database:
        return Path(section.database)
    data = Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share")
    return data / "retouch" / robot / "model.sqlite"


def build(bus: Bus, clock: Clock, configuration: Configuration) -> ModelService:
    """The service, its store opened and its model rebuilt.

    Raises:
        ServiceError: the database cannot be used.
    """
    del clock
    path = database_path(configuration.model, configuration.name)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        store = DemonstrationStore(path)
    except LfdError as error:
        raise ServiceError(str(error)) from None
    except OSError as error:
        raise ServiceError(f"cannot make {path.parent}: {error.strerror}") from None
    return ModelService(bus, store, configuration.model.kind)


def learn_all(kind: str, stored: list[StoredDemonstration]) -> MovementModel | None:
    """The model that the stored demonstrations make, in their order; None before the first."""
    initial = [s.demonstration for s in stored if s.kind is StoredKind.INITIAL]
    updates = [s.demonstration for s in stored if s.kind is StoredKind.UPDATE]
    if not initial:
        initial, updates = updates[:1], updates[1:]
    if not initial:
        return None
    model: MovementModel = MODELS[kind].fit(initial)
    for update in updates:
        model = model.updated(update)
    return model


class ModelService:
    """Predicts, learns and takes back.

    Args:
        bus: to answer on.
        store: every demonstration and update; the model is what it holds.
        kind: of the model, a key of `MODELS`.
    """

    rate_hz = 100.0

    def __init__(self, bus: Bus, store: DemonstrationStore, kind: str) -> None:
        self._bus = bus
        self._store = store
        self._kind = kind
        self._stored = store.active()
        self._model = learn_all(kind, self._stored)
        self._predict = bus.serve(queries.PREDICT)
        self._add = bus.serve(queries.ADD_DEMONSTRATION)
        self._undo = bus.serve(queries.UNDO)
        self._describe = bus.serve(queries.DESCRIBE)
        self._announced_ns = 0
        self._newest: messages.Prediction | None = None
        log.info("model version %d: %d demonstrations", store.version, len(self._stored))

    def step(self, now_ns: int) -> None:
        """Answer what was asked."""
        _answer(self._predict, self._predicted)
        _answer(self._add, self._learnt)
        _answer(self._undo, self._undone)
        _answer(self._describe, self._described)
        if now_ns - self._announced_ns >= 1e9 / topics.MODEL_STATE.rate_hz:
            self._announced_ns = now_ns
            self._bus.publish(topics.MODEL_STATE, self._state())
            if self._newest is not None:
                self._bus.publish(topics.PREDICTION, self._newest)

    def figures(self) -> tuple[messages.Figure, ...]:
        """The model's size."""
        return (messages.Figure("demonstrations", float(len(self._stored)), "1"),)

    def close(self) -> None:
        """Close the database."""
        self._store.close()

    def _predicted(self, request: Predict) -> Predicted | Refused:
        if self._model is None:
            return Refused("the model has no demonstration yet: teach it first")
        prediction = self._model.predict(_situation(request))
        variances = np.diagonal(prediction.position_covariances, axis1=1, axis2=2)
        motion = prediction.trajectory
        self._newest = messages.Prediction(
            id=new_number(),
            motion=motion_to_wire(motion.positions, motion.orientations, motion.duration),
            deviations=to_wire(np.sqrt(np.maximum(variances, 0.0))),
            model_version=self._store.version,
            object_position=request.object_position,
        )
        self._bus.publish(topics.PREDICTION, self._newest)
        return Predicted(self._newest)

    def _learnt(self, request: AddDemonstration) -> queries.Learnt:
        positions, orientations, duration = motion_from_wire(request.motion)
        motion = _learnable(request, Trajectory(positions, orientations, duration))
        origin = np.array(request.object_position, dtype=np.float64)
        demonstration = (
            Demonstration(motion, origin, np.array(request.condition))
            if request.condition
            else Demonstration.reaching(motion, origin)
        )
        kind = StoredKind(request.kind.value)
        candidate = self._extended(demonstration, kind)
        self._store.add(demonstration, kind, request.scene)
        self._model, self._stored = candidate, self._store.active()
        return queries.Learnt(self._state())

    def _extended(self, demonstration: Demonstration, kind: StoredKind) -> MovementModel | None:
        if kind is StoredKind.UPDATE and self._model is not None:
            return self._model.updated(demonstration)
        version = self._store.version + 1
        return learn_all(self._kind, [*self._stored, StoredDemonstration(version, kind, "", demonstration)])

    def _undone(self, request: queries.Undo) -> queries.Learnt | Refused:
        del request
        if not any(s.kind is StoredKind.UPDATE for s in self._stored):
            return Refused("there is no update to take back")
        self._store.undo()
        self._stored = self._store.active()
        self._model = learn_all(self._kind, self._stored)
        return queries.Learnt(self._state())

    def _described(self, request: queries.Describe) -> queries.Learnt:
        del request
        return queries.Learnt(self._state())

    def _state(self) -> messages.ModelState:
        return messages.ModelState(
            kind=self._kind,
            version=self._store.version,
            demonstrations=sum(s.kind is StoredKind.INITIAL for s in self._stored),
            updates=sum(s.kind is StoredKind.UPDATE for s in self._stored),
            scene=self._stored[-1].scene if self._stored else "",
        )


def _learnable(request: AddDemonstration, motion: Trajectory) -> Trajectory:
    """Equation (18): the whole motion, or the prediction moved a part of the way towards it."""
    if request.alpha == 1.0 or request.prediction is None:
        return motion
    return refine(Trajectory(*motion_from_wire(request.prediction)), motion, request.alpha, motion.n_points)


def _situation(request: Predict) -> Situation:
    origin, start = np.array(request.object_position), request.start
    position, orientation = np.array(start.position), np.array(start.orientation)
    if not request.condition:
        return Situation.reaching(origin, position, orientation)
    return Situation(np.array(request.condition), origin, position, orientation)


def _answer(server: Server[Req, Rep], answer: Callable[[Req], Rep | Refused]) -> None:
    for call in server.take():
        try:
            reply = answer(call.request)
        except (LfdError, ServiceError) as error:
            log.warning("refused: %s", error)
            reply = Refused(str(error))
        call.reply(reply)
