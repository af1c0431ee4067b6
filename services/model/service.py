"""The model process' shell: answers queries from a store on disk and a model in memory."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from typing import TypeVar

import numpy as np

from lfd.store.database import DemonstrationStore
from lfd.store.stored import Counts, Purpose, StoredDemonstration
from protocol import messages, queries, topics
from protocol.queries import (
    AddDemonstration,
    ChooseSkill,
    Compare,
    Compared,
    HistoryListed,
    Learnt,
    ListHistory,
    Plan,
    Predict,
    Predicted,
    Redo,
    Refused,
    Undo,
)
from services.bus.arrays import motion_to_wire, to_wire
from services.bus.bus import Bus
from services.bus.identity import new_number
from services.model.answering import answer
from services.model.comparison import Comparisons
from services.model.history import History
from services.model.learning import MODELS, Fit
from services.model.planning import planned
from services.model.requests import demonstration_in, situation_in
from services.model.skill import binding_of, check_demonstration, check_duration, check_situation
from services.model.skills import Skills
from services.process.clock import Clock
from services.process.config import Configuration
from services.process.robots import scene_of
from services.process.schedule import Schedule
from sim.tasks import AnyScene

log = logging.getLogger(__name__)

Learns = TypeVar("Learns", AddDemonstration, Undo, Redo)


def build(bus: Bus, clock: Clock, configuration: Configuration, models: Mapping[str, Fit] = MODELS) -> ModelService:
    """The service, its store opened and its model rebuilt.

    Args:
        bus: to answer on.
        clock: not needed.
        configuration: of all services.
        models: to choose from.

    Raises:
        StorageError: the file of the skill in use cannot be used.
        SkillError: that skill is for another scene or robot, or is not there.
        EnvironmentFault: its folder cannot be made or written.
        SimError: there is no such scene.
    """
    del clock
    scene = scene_of(configuration.robot)
    section, binding = configuration.model, binding_of(scene)

    def made(store: DemonstrationStore) -> History:
        return History(store, binding, section.kind, models)

    skills = Skills(section, configuration.name, binding, made, lambda: datetime.now(UTC).timestamp())
    try:
        return ModelService(bus, skills, section.kind, scene, lambda: datetime.now(UTC))
    except BaseException:
        skills.close()
        raise


class ModelService:
    """Predicts, learns and takes back.

    Args:
        bus: to answer on.
        skills: of the robot; the model is what the one in use holds.
        kind: of the model.
        scene: that it learns for.
        utc: the time of day, which what is learnt is stored with.
    """

    rate_hz = 100.0

    def __init__(self, bus: Bus, skills: Skills, kind: str, scene: AnyScene, utc: Callable[[], datetime]) -> None:
        self._bus = bus
        self._utc = utc
        self._kind = kind
        self._scene = scene
        self._binding = binding_of(scene)
        self._skills = skills
        self._comparisons = Comparisons(self._history, scene)
        self._predict = bus.serve(queries.PREDICT)
        self._plan = bus.serve(queries.PLAN)
        self._add = bus.serve(queries.ADD_DEMONSTRATION)
        self._undo = bus.serve(queries.UNDO)
        self._redo = bus.serve(queries.REDO)
        self._list = bus.serve(queries.HISTORY)
        self._compare = bus.serve(queries.COMPARE)
        self._describe = bus.serve(queries.DESCRIBE)
        self._list_skills = bus.serve(queries.SKILLS)
        self._choose = bus.serve(queries.CHOOSE_SKILL)
        self._stands_in = bus.subscribe(topics.SCENE_STATE)
        self._schedule = Schedule()
        self._newest: messages.Prediction | None = None
        told = skills.name, self._binding, self._history.version, self._size
        log.info("skill %r, %s: model version %d, %d demonstrations", *told)

    def step(self, now_ns: int) -> None:
        """Answer what was asked."""
        answer(self._predict, self._predicted)
        answer(self._plan, self._planned)
        answer(self._add, self._once(self._learnt))
        answer(self._undo, self._once(self._undone))
        answer(self._redo, self._once(self._redone))
        answer(self._list, self._listed)
        answer(self._compare, self._compared)
        answer(self._describe, self._described)
        answer(self._list_skills, lambda _: self._skills.listed())
        answer(self._choose, self._chosen)
        self._comparisons.step()
        if self._schedule.due(topics.MODEL_STATE, now_ns):
            self._bus.publish(topics.MODEL_STATE, self._state)
            if self._newest is not None:
                self._bus.publish(topics.PREDICTION, self._newest)

    def figures(self) -> tuple[messages.Figure, ...]:
        """The model's size."""
        return (messages.Figure("demonstrations", float(self._size), "1"),)

    def close(self) -> None:
        """Close the database."""
        self._skills.close()

    @property
    def _history(self) -> History:
        """Of the skill in use."""
        return self._skills.history

    @property
    def _name(self) -> str:
        """Of the skill in use, as messages have it."""
        return self._skills.name[:64]

    @property
    def _size(self) -> int:
        return sum(self._history.counts)

    def _once(self, change: Callable[[Learns], Learnt | Refused]) -> Callable[[Learns], Learnt | Refused]:
        """The change, or the answer to a request that has made it already: in this process or in one before it."""

        def changed(request: Learns) -> Learnt | Refused:
            done = self._history.made_by(request.request)
            if done is None:
                return self._other(request.skill) or change(request)
            made, counts = done
            return Learnt(self._told(made.version, counts), made.demonstration, self._purpose(made.demonstration))

        return changed

    def _other(self, skill: str) -> Refused | None:
        """Why nothing is changed: it was meant for a skill that is not in use any more."""
        if skill in ("", self._name):
            return None
        return Refused(f"this was meant for skill {skill!r}, and {self._name!r} is in use now: choose that one first")

    def _chosen(self, request: ChooseSkill) -> Learnt:
        self._skills.choose(request)
        self._comparisons = Comparisons(self._history, self._scene)
        self._newest = None
        self._bus.publish(topics.MODEL_STATE, self._state)
        return Learnt(self._state)

    def _predicted(self, request: Predict) -> Predicted | Refused:
        there = self._stands_in.latest()
        if there is not None and there.message.name != self._scene.name:
            return Refused(
                f"the robot stands in scene {there.message.name}, and this model is for {self._binding}:"
                " start both with the same --scene"
            )
        model = self._history.model
        if model is None:
            return Refused("the model has no demonstration yet: teach it first")
        situation = situation_in(request)
        check_situation(self._scene, situation)
        prediction = model.predict(situation)
        check_duration("the prediction's duration", prediction.trajectory)
        variances = np.diagonal(prediction.position_covariances, axis1=1, axis2=2)
        motion = prediction.trajectory
        return self._announced(
            messages.Prediction(
                id=new_number(),
                motion=motion_to_wire(motion.positions, motion.orientations, motion.duration, motion.opening),
                deviations=to_wire(np.sqrt(np.maximum(variances, 0.0))),
                model_version=self._history.version,
                object_position=request.object_position,
                known=prediction.known,
                way=messages.Way(prediction.way.index, prediction.way.count, prediction.way.probability),
                skill=self._name,
            )
        )

    def _planned(self, request: Plan) -> Predicted | Refused:
        """What an operator showed, as it will be executed; an empty model does not mind."""
        if request.scene != self._scene.name:
            return self._elsewhere(f"the plan is of scene {request.scene}", request.scene)
        motion, waypoints = planned(self._scene, request)
        return self._announced(
            messages.Prediction(
                id=new_number(),
                motion=motion_to_wire(motion.positions, motion.orientations, motion.duration, motion.opening),
                deviations=to_wire(np.zeros_like(motion.positions)),
                model_version=self._history.version,
                object_position=request.object_position,
                origin=request.origin,
                waypoints=waypoints,
                skill=self._name,
            )
        )

    def _announced(self, prediction: messages.Prediction) -> Predicted:
        self._newest = prediction
        self._bus.publish(topics.PREDICTION, prediction)
        return Predicted(prediction)

    def _elsewhere(self, what: str, scene: str) -> Refused:
        return Refused(f"{what}, and this model is for {self._binding}: start the model with --scene {scene}")

    def _learnt(self, request: AddDemonstration) -> Learnt | Refused:
        if request.scene != self._scene.name:
            return self._elsewhere(f"the demonstration is of scene {request.scene}", request.scene)
        demonstration = demonstration_in(request, self._now_s())
        check_demonstration(self._scene, demonstration)
        self._history.add(demonstration, Purpose(request.purpose.value), request.request)
        return self._changed(self._history.version)

    def _undone(self, request: Undo) -> Learnt | Refused:
        if request.entry:
            entry = self._history.find(request.entry)
        else:
            purpose = Purpose(request.purpose.value)
            newest = self._history.newest(purpose)
            if newest is None:
                known = "update" if purpose is Purpose.UPDATE else "first demonstration"
                return Refused(f"there is no {known} to take back")
            entry = newest
        return self._turned(entry, request, in_use=False)

    def _redone(self, request: Redo) -> Learnt | Refused:
        return self._turned(self._history.find(request.entry), request, in_use=True)

    def _turned(self, entry: StoredDemonstration, request: Undo | Redo, *, in_use: bool) -> Learnt:
        self._history.turn(entry, in_use=in_use, author=request.operator, at_s=self._now_s(), request=request.request)
        return self._changed(entry.version)

    def _changed(self, entry: int) -> Learnt:
        """Told as it is on disk by now; what the entry changes is worked out before anybody asks."""
        self._comparisons.of(self._history.find(entry))
        return Learnt(self._state, entry, self._purpose(entry))

    def _purpose(self, entry: int) -> messages.Purpose:
        return messages.Purpose(self._history.find(entry).purpose.value)

    def _listed(self, request: ListHistory) -> HistoryListed:
        return self._history.listed(request.before)

    def _compared(self, request: Compare) -> Compared | Refused:
        return self._comparisons.of(self._history.find(request.entry))

    def _described(self, request: queries.Describe) -> Learnt:
        del request
        return Learnt(self._state)

    @property
    def _state(self) -> messages.ModelState:
        return self._told(self._history.version, self._history.counts)

    def _now_s(self) -> float:
        return self._utc().timestamp()

    def _told(self, version: int, counts: Counts) -> messages.ModelState:
        return messages.ModelState(
            kind=self._kind,
            version=version,
            demonstrations=counts.initial,
            updates=counts.updates,
            scene=self._binding.scene,
            robot_kind=self._binding.robot,
            skill=self._name,
        )
