"""The model process' shell: answers queries from a store on disk and a model in memory."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from dataclasses import replace
from datetime import UTC, datetime
from typing import TypeVar

import numpy as np

from lfd.exceptions import LfdError
from lfd.models.model import MovementModel
from lfd.motion.demonstration import Demonstration, Situation
from lfd.motion.provenance import Provenance
from lfd.motion.trajectory import Trajectory
from lfd.store.database import DemonstrationStore
from lfd.store.stored import Counts, Purpose, StoredDemonstration
from protocol import messages, queries, topics
from protocol.queries import AddDemonstration, Learnt, Predict, Predicted, Refused, Undo
from services.bus.arrays import motion_from_wire, motion_to_wire, to_wire
from services.bus.bus import Bus, Rep, Req
from services.bus.identity import new_number
from services.bus.server import Server
from services.model.learning import MODELS, Fit, learn_all
from services.model.skill import binding_of, check_demonstration, check_duration, check_situation, open_store
from services.process.clock import Clock
from services.process.config import Configuration
from services.process.exceptions import ServiceError
from services.process.schedule import Schedule
from sim.exceptions import SimError
from sim.tasks import AnyScene
from sim.tasks import scene as find_scene

log = logging.getLogger(__name__)

Learns = TypeVar("Learns", AddDemonstration, Undo)


def build(bus: Bus, clock: Clock, configuration: Configuration, models: Mapping[str, Fit] = MODELS) -> ModelService:
    """The service, its store opened and its model rebuilt.

    Args:
        bus: to answer on.
        clock: not needed.
        configuration: of all services.
        models: to choose from.

    Raises:
        StorageError: the database cannot be used, or holds what was learnt for another scene or robot.
        EnvironmentFault: its folder cannot be made or written.
        SimError: there is no such scene.
    """
    del clock
    scene = find_scene(configuration.robot.scene)
    store = open_store(configuration.model, configuration.name, binding_of(scene))
    try:
        return ModelService(bus, store, configuration.model.kind, scene, lambda: datetime.now(UTC), models=models)
    except BaseException:
        store.close()
        raise


class ModelService:
    """Predicts, learns and takes back.

    Args:
        bus: to answer on.
        store: every demonstration and update; the model is what it holds.
        kind: of the model, a key of `models`.
        scene: that it learns for.
        utc: the time of day, which what is learnt is stored with.
        models: to choose from.
    """

    rate_hz = 100.0

    def __init__(
        self,
        bus: Bus,
        store: DemonstrationStore,
        kind: str,
        scene: AnyScene,
        utc: Callable[[], datetime],
        *,
        models: Mapping[str, Fit] = MODELS,
    ) -> None:
        self._bus = bus
        self._utc = utc
        self._store = store
        self._kind = kind
        self._models = models
        self._scene = scene
        self._binding = binding_of(scene)
        self._stored = store.active()
        self._model = learn_all(kind, self._stored, models)
        self._predict = bus.serve(queries.PREDICT)
        self._add = bus.serve(queries.ADD_DEMONSTRATION)
        self._undo = bus.serve(queries.UNDO)
        self._describe = bus.serve(queries.DESCRIBE)
        self._stands_in = bus.subscribe(topics.SCENE_STATE)
        self._schedule = Schedule()
        self._newest: messages.Prediction | None = None
        # Kept here: what is announced must not wait for a file that somebody holds.
        self._state = self._state_in(store.version)
        log.info("%s: model version %d, %d demonstrations", self._binding, self._state.version, len(self._stored))

    def step(self, now_ns: int) -> None:
        """Answer what was asked."""
        _answer(self._predict, self._predicted)
        _answer(self._add, self._once(self._learnt))
        _answer(self._undo, self._once(self._undone))
        _answer(self._describe, self._described)
        if self._schedule.due(topics.MODEL_STATE, now_ns):
            self._bus.publish(topics.MODEL_STATE, self._state)
            if self._newest is not None:
                self._bus.publish(topics.PREDICTION, self._newest)

    def figures(self) -> tuple[messages.Figure, ...]:
        """The model's size."""
        return (messages.Figure("demonstrations", float(len(self._stored)), "1"),)

    def close(self) -> None:
        """Close the database."""
        self._store.close()

    def _once(self, change: Callable[[Learns], Learnt | Refused]) -> Callable[[Learns], Learnt | Refused]:
        """The change, or the answer to a request that has made it already: in this process or in one before it."""

        def changed(request: Learns) -> Learnt | Refused:
            version = self._store.made_by(request.request) if request.request else None
            return change(request) if version is None else Learnt(self._state_in(version))

        return changed

    def _predicted(self, request: Predict) -> Predicted | Refused:
        there = self._stands_in.latest()
        if there is not None and there.message.name != self._scene.name:
            return Refused(
                f"the robot stands in scene {there.message.name}, and this model is for {self._binding}:"
                " start both with the same --scene"
            )
        if self._model is None:
            return Refused("the model has no demonstration yet: teach it first")
        situation = _situation(request)
        check_situation(self._scene, situation)
        prediction = self._model.predict(situation)
        check_duration("the prediction's duration", prediction.trajectory)
        variances = np.diagonal(prediction.position_covariances, axis1=1, axis2=2)
        motion = prediction.trajectory
        self._newest = messages.Prediction(
            id=new_number(),
            motion=motion_to_wire(motion.positions, motion.orientations, motion.duration),
            deviations=to_wire(np.sqrt(np.maximum(variances, 0.0))),
            model_version=self._state.version,
            object_position=request.object_position,
            known=prediction.known,
            way=messages.Way(prediction.way.index, prediction.way.count, prediction.way.probability),
        )
        self._bus.publish(topics.PREDICTION, self._newest)
        return Predicted(self._newest)

    def _learnt(self, request: AddDemonstration) -> Learnt | Refused:
        if request.scene != self._scene.name:
            return Refused(
                f"the demonstration is of scene {request.scene}, and this model is for {self._binding}:"
                f" start the model with --scene {request.scene}"
            )
        demonstration = _demonstration(request, self._utc().timestamp())
        check_demonstration(self._scene, demonstration)
        purpose = Purpose(request.purpose.value)
        candidate = self._extended(demonstration, purpose)
        version = self._store.add(demonstration, purpose, self._binding, request.request)
        added = StoredDemonstration(version, purpose, self._binding, demonstration)
        return self._changed(candidate, [*self._stored, added], version)

    def _extended(self, demonstration: Demonstration, purpose: Purpose) -> MovementModel | None:
        if purpose is Purpose.UPDATE and self._model is not None:
            return self._model.updated(demonstration)
        added = StoredDemonstration(self._state.version + 1, purpose, self._binding, demonstration)
        return learn_all(self._kind, [*self._stored, added], self._models)

    def _undone(self, request: Undo) -> Learnt | Refused:
        purpose = Purpose(request.purpose.value)
        newest = next((one for one in reversed(self._stored) if one.purpose is purpose), None)
        if newest is None:
            known = "update" if purpose is Purpose.UPDATE else "first demonstration"
            return Refused(f"there is no {known} to take back")
        left = [one for one in self._stored if one is not newest]
        model = learn_all(self._kind, left, self._models)
        return self._changed(model, left, self._store.undo(newest.version, request.request))

    def _changed(self, model: MovementModel | None, stored: list[StoredDemonstration], version: int) -> Learnt:
        """Take over what is on disk by now; nothing here can fail."""
        self._model, self._stored = model, stored
        self._state = self._told(version, Counts.of(stored))
        return Learnt(self._state)

    def _described(self, request: queries.Describe) -> Learnt:
        del request
        return Learnt(self._state)

    def _state_in(self, version: int) -> messages.ModelState:
        return self._told(version, self._store.counts(version))

    def _told(self, version: int, counts: Counts) -> messages.ModelState:
        return messages.ModelState(
            kind=self._kind,
            version=version,
            demonstrations=counts.initial,
            updates=counts.updates,
            scene=self._binding.scene,
            robot_kind=self._binding.robot,
        )


def _demonstration(request: AddDemonstration, at_s: float) -> Demonstration:
    motion = Trajectory(*motion_from_wire(request.motion))
    origin = np.array(request.object_position, dtype=np.float64)
    provenance = Provenance(request.operator, at_s, request.alpha)
    part = request.part.first, request.part.last
    if request.condition:
        return Demonstration(motion, origin, np.array(request.condition), provenance, part)
    return replace(Demonstration.reaching(motion, origin, provenance), part=part)


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
        except (LfdError, ServiceError, SimError) as error:
            log.warning("refused: %s", error)
            reply = Refused(str(error))
        call.reply(reply)
