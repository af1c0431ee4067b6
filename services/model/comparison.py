"""What an entry of the history changes, worked out slice by slice: no slice takes longer than a prediction or two."""

from __future__ import annotations

from collections import OrderedDict, deque
from collections.abc import Generator

import numpy as np

from lfd.exceptions import LfdError
from lfd.models.model import MovementModel
from lfd.motion.demonstration import Situation
from lfd.motion.trajectory import Trajectory
from lfd.store.stored import StoredDemonstration
from protocol.messages import Motion
from protocol.queries import Compared, Effect, Field, Refused
from services.bus.arrays import Floats, motion_to_wire, to_wire, vector3
from services.model.history import History
from sim.tasks import AnyScene

Slices = Generator[None, None, Effect]

PLACES = 7
"""Along each side of the field."""

POINTS = 50
"""Of a predicted motion: no two that are compared differ more between these."""

KEPT = 64
"""Effects of the model as it is; more than a page shows at once."""


class Comparisons:
    """The effects that were asked for, of the model as it is now.

    Args:
        history: whose entries they are.
        scene: over whose places predictions are compared.
    """

    def __init__(self, history: History, scene: AnyScene) -> None:
        self._history = history
        self._scene = scene
        self._version = history.version
        self._waiting: deque[tuple[int, Slices]] = deque()
        self._known: OrderedDict[int, Effect | Refused | None] = OrderedDict()

    def of(self, entry: StoredDemonstration) -> Compared | Refused:
        """The effect of an entry, if it is there; where it is not it will be, before what was asked for earlier."""
        self._forget_others()
        if entry.version not in self._known:
            self._known[entry.version] = None
            self._waiting.append((entry.version, _slices(self._history, entry, self._scene)))
            if len(self._known) > KEPT:
                oldest, _ = self._known.popitem(last=False)
                self._waiting = deque(one for one in self._waiting if one[0] != oldest)
        # Somebody waits for it now: for others, who ask no more, there is time.
        self._waiting = deque(sorted(self._waiting, key=lambda one: one[0] != entry.version))
        found = self._known[entry.version]
        return found if isinstance(found, Refused) else Compared(self._version, found)

    def step(self) -> None:
        """Work a little on what was asked for last."""
        self._forget_others()
        if not self._waiting:
            return
        entry, slices = self._waiting[0]
        try:
            next(slices)
        except StopIteration as done:
            self._known[entry] = done.value
            self._waiting.popleft()
        except LfdError as error:
            self._known[entry] = Refused(f"entry {entry} cannot be compared: {error}")
            self._waiting.popleft()

    def _forget_others(self) -> None:
        """Effects in another model than the one that is there now."""
        if self._version != self._history.version:
            self._version = self._history.version
            self._waiting.clear()
            self._known.clear()


def _slices(history: History, entry: StoredDemonstration, scene: AnyScene) -> Slices:
    """The effect of an entry, a slice at each step."""
    with_entry, without_entry = history.compared(entry)
    with_it = history.made_of(with_entry)
    yield
    without_it = history.made_of(without_entry)
    yield
    given = entry.demonstration
    after, before = (None if model is None else _motion(model, given.situation) for model in (with_it, without_it))
    yield
    field = None
    if with_it is not None and without_it is not None:
        field = yield from _field(with_it, without_it, given.situation, scene)
    return Effect(vector3(given.origin), after, before, field)


def _field(
    with_it: MovementModel, without_it: MovementModel, start: Situation, scene: AnyScene
) -> Generator[None, None, Field]:
    """How far predictions are moved over a scene's places, from one start: a place a slice."""
    lower, upper = np.array(scene.region.lower), np.array(scene.region.upper)
    rows, columns = _widest(upper - lower)
    sides = [np.linspace(lower[axis], upper[axis], PLACES) for axis in (rows, columns)]
    figures = np.zeros((3, PLACES, PLACES))
    for i, row in enumerate(sides[0]):
        for j, column in enumerate(sides[1]):
            place = (lower + upper) / 2.0
            place[rows], place[columns] = row, column
            situation = _situation(place, start, scene)
            after, before = (model.predict(situation, POINTS) for model in (with_it, without_it))
            figures[:, i, j] = _moved(after.trajectory, before.trajectory), after.known, before.known
            yield
    moved, known, known_without = (to_wire(figure) for figure in figures)
    least, greatest = ((float(end[rows]), float(end[columns])) for end in (lower, upper))
    return Field((rows, columns), least, greatest, moved, known, known_without)


def _widest(widths: Floats) -> tuple[int, int]:
    """The two widest axes, in their order; the same one twice where there is no other."""
    one, *other = np.argsort(-widths, kind="stable")[:2].tolist()
    return (min(one, *other), max(one, *other)) if other else (one, one)


def _situation(place: Floats, start: Situation, scene: AnyScene) -> Situation:
    if scene.has_object:
        return Situation.reaching(place, start.start_position, start.start_orientation)
    return Situation(place, start.origin, start.start_position, start.start_orientation)


def _moved(one: Trajectory, other: Trajectory) -> float:
    return float(np.max(np.linalg.norm(one.positions - other.positions, axis=1)))


def _motion(model: MovementModel, situation: Situation) -> Motion:
    predicted = model.predict(situation).trajectory
    return motion_to_wire(predicted.positions, predicted.orientations, predicted.duration, predicted.opening)
