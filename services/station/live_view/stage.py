"""Puts together what the live view draws, from what the station hears."""

from __future__ import annotations

import numpy as np

from lfd import haptics
from protocol.messages import (
    ExecutionState,
    MasterState,
    Mode,
    ObjectPose,
    Pose,
    Prediction,
    SceneState,
    Vector3,
    Verdict,
)
from services.bus.arrays import Floats, drawable, vector3
from services.bus.trace import Trace
from services.station.ears import Ears, message
from services.station.live_view.drawing import Criteria, Curve, Drawing, Going, Kick, Point

_POINTS = 80
"""Of a motion: a line through more looks the same."""

_SIGMAS = 2.0
_DIGITS = 4
_MILLIMETRES = 3
"""Digits: cameras see no more."""
_NO_FORCE: Vector3 = (0.0, 0.0, 0.0)


class Stage:
    """What is to be seen.

    Args:
        ears: what the station hears.
    """

    def __init__(self, ears: Ears) -> None:
        self._ears = ears
        self._trace = Trace()
        self._way: tuple[Point, ...] = ()
        self._curve: tuple[Prediction | None, Curve | None] = (None, None)

    def drawing(self, now_ns: int, waypoints: tuple[Pose, ...] = ()) -> Drawing:
        """What changes now and then, as it is now.

        Args:
            now_ns: the time.
            waypoints: that are stored.
        """
        robot = message(self._ears.robot.latest())
        if robot is not None and self._trace.see(robot):
            self._way = told(self._trace.points)
        scene, verdict = message(self._ears.scene.latest()), message(self._ears.verdict.latest())
        return Drawing(
            boxes=() if scene is None else scene.boxes,
            size=_NO_FORCE if scene is None else scene.object_size,
            prediction=self._predicted(now_ns),
            going=_going(self._ears.execution.fresh(now_ns)),
            way=self._way,
            criteria=_criteria(scene, verdict),
            kick=_kick(scene, verdict, message(self._ears.seen.latest())),
            waypoints=tuple(waypoint.position for waypoint in waypoints),
            yaw=self.yaw(now_ns),
        )

    def yaw(self, now_ns: int) -> float:
        """By which the axes of the operator's device are turned to the left of the base's [rad]."""
        master = self._ears.master.fresh(now_ns)
        return 0.0 if master is None else master.yaw

    def force(self, now_ns: int) -> Vector3:
        """That the operator feels now, or would at a device that renders it (eq. 14) [N]."""
        master = self._ears.master.fresh(now_ns)
        if master is None:
            return _NO_FORCE
        return master.force if any(master.force) or not master.engaged else _rendered(master)

    def spoilt(self, now_ns: int) -> tuple[float, ...]:
        """Shares of the motion that is shown at which the last episode of it touched or kicked over something."""
        result, shown = message(self._ears.results.latest()), self._shown(now_ns)
        if result is None or shown is None or result.prediction != shown.id:
            return ()
        return (result.clear_until,) if result.clear_until < result.progress else ()

    def _shown(self, now_ns: int) -> Prediction | None:
        return self._ears.predictions.shown(self._ears.execution.fresh(now_ns))

    def _predicted(self, now_ns: int) -> Curve | None:
        prediction = self._shown(now_ns)
        if prediction is not self._curve[0]:
            self._curve = prediction, None if prediction is None else _curve(prediction)
        return self._curve[1]


def _rendered(master: MasterState) -> Vector3:
    return vector3(haptics.force(np.array(master.displacement), np.array(master.velocity)))


def _going(execution: ExecutionState | None) -> Going | None:
    if execution is None or execution.mode is Mode.TEACH:
        return None
    return Going(
        fading=execution.duration / execution.look_ahead if execution.look_ahead > 0.0 else 0.0,
        first=execution.part.first,
        last=execution.part.last,
        corrected=execution.mode is Mode.REFINE,
    )


def _criteria(scene: SceneState | None, verdict: Verdict | None) -> Criteria:
    radii = _NO_FORCE if scene is None else scene.ellipsoid_radii
    if verdict is None:
        return Criteria(radii)
    return Criteria(radii, verdict.reached, verdict.collision_position, verdict.collision_force)


def _kick(scene: SceneState | None, verdict: Verdict | None, seen: ObjectPose | None) -> Kick:
    if scene is None or verdict is None or seen is None or not any(scene.object_size):
        return Kick()
    stood = np.subtract(seen.pose.position, verdict.object_displacement).round(_MILLIMETRES)
    return Kick(vector3(stood), scene.kicked_over_thresholds, verdict.kicked_over)


def _curve(prediction: Prediction) -> Curve | None:
    """None of numbers that cannot be drawn."""
    positions, deviations = drawable(prediction.motion.positions), drawable(prediction.deviations)
    if positions is None:
        return None
    orientations = drawable(prediction.motion.orientations)
    spread = deviations is not None and deviations.shape == positions.shape
    return Curve(
        told(positions),
        told(_SIGMAS * deviations) if spread and deviations is not None else (),
        told(orientations) if orientations is not None else (),
        prediction.origin,
    )


def told(points: Floats) -> tuple[Point, ...]:
    """As many of the points as can be told apart, to a tenth of a millimetre."""
    chosen = np.unique(np.linspace(0, len(points) - 1, min(_POINTS, len(points))).round().astype(int))
    return tuple(map(tuple, points[chosen].round(_DIGITS).tolist()))
