"""The only Rerun logger: everything of interest on one time line, live and in a file at once."""

from __future__ import annotations

import logging
from collections.abc import Sequence

import numpy as np

from protocol.messages import Figure, Pose, Prediction, Recording
from protocol.topics import DEPTH, EXECUTION, OBJECT_POSE, POINT_CLOUD, RECORDING, SCENE_STATE, VERDICT, WORLD_STATE
from services.bus.arrays import drawable, vector3
from services.bus.bus import Bus
from services.bus.depth import depth_from_wire
from services.bus.predictions import Predictions
from services.bus.trace import Trace
from services.process.clock import Clock
from services.process.config import Configuration
from services.process.robots import camera_names, known_scene
from services.process.runner import Service
from services.viewer import motions, scene, series
from services.viewer.journal import Journal
from services.viewer.news import Changes, News
from services.viewer.pictures import Pictures
from services.viewer.robot import Robot
from services.viewer.robot_model import RobotModel
from services.viewer.run import Run
from services.viewer.teaching import Teaching
from services.viewer.teleoperation import Teleoperation
from services.viewer.web import WebServer
from services.viewer.web_files import web_files
from services.viewer.words import Words
from sim.exceptions import SimError
from sim.robots.catalogue import DEFAULT
from sim.robots.description import prepare
from sim.robots.robot import USUAL_CAMERAS
from sim.tasks import AnyScene, described
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import Eye

log = logging.getLogger(__name__)

RATE_HZ = 30.0

# What stands still is drawn again this often: whoever opens the page late has not seen the first time.
_REPEAT_S = 5.0

_ANNOUNCE_S = 1.0

# The whole way so far is drawn each time.
_TRACE_S = 0.2

_TEXT_LENGTH = 4096


def build(bus: Bus, clock: Clock, configuration: Configuration) -> Service:
    """The viewer process.

    Raises:
        PortInUse: another program listens where its page should be.
        FolderUnusable: the recording cannot be written.
        WebFilesMissing: the web viewer's files are not there.
    """
    web = WebServer(configuration.viewer, web_files())
    # A scene that is not known here has an arm like ours, as far as anybody can tell.
    known = known_scene(configuration.robot)
    eye, cameras = known.eye if known else Eye(), camera_names(configuration)
    try:
        run = Run(configuration.viewer, configuration.name, clock.now_ns(), eye, cameras)
    except BaseException:
        web.close()
        raise
    point = known.point if known else None
    return ViewerService(bus, run, web, point=point, known=known, cameras=cameras)


class ViewerService:
    """Draws what the other processes publish.

    Args:
        bus: to them.
        run: where it is drawn.
        web: the page to look at it.
        point: radius of a robot that is a point [m]; None for an arm.
        known: the scene, where it is known here.
        cameras: their names.
    """

    def __init__(
        self,
        bus: Bus,
        run: Run,
        web: WebServer,
        *,
        point: float | None = None,
        known: AnyScene | None = None,
        cameras: Sequence[str] = USUAL_CAMERAS,
    ) -> None:
        self._bus = bus
        self._run = run
        self._web = web
        self._journal = Journal()
        self._words = Words(run)
        self._world = News(bus.subscribe(WORLD_STATE))
        self._scene = News(bus.subscribe(SCENE_STATE))
        self._object = News(bus.subscribe(OBJECT_POSE))
        self._verdict = News(bus.subscribe(VERDICT))
        self._predictions = Predictions(bus)
        self._execution = bus.subscribe(EXECUTION)
        self._trace = Trace()
        self._cloud = News(bus.subscribe(POINT_CLOUD))
        self._depth = News(bus.subscribe(DEPTH))
        self._pictures = Pictures(bus, run, cameras)
        self._changes = Changes(_REPEAT_S)
        self._tracing = Changes(_TRACE_S)
        self._announcing = Changes(_ANNOUNCE_S)
        self._unusable = 0
        run.at(0)
        series.log_legends(run)
        self._robot = Robot(bus, run, self._words, self._journal, _robot_model(run, known) if point is None else None)
        self._teleoperation = Teleoperation(bus, run, self._words, self._journal)
        self._teaching = Teaching(bus, run, self._words, self._journal)
        if point is not None:
            scene.log_point(run, point)

    @property
    def rate_hz(self) -> float:
        """As smooth as eyes ask for; the robot's own rate would only cost."""
        return RATE_HZ

    def step(self, now_ns: int) -> None:
        """Draw what is new."""
        self._run.at(now_ns)
        robot = self._robot.draw(now_ns)
        if robot is not None:
            self._trace.see(robot)
        known = self._robot.known
        self._teleoperation.draw(known.measured.position if known is not None else None, now_ns)
        self._log_scene(now_ns)
        self._log_verdict(now_ns)
        self._pictures.draw(now_ns)
        self._log_depth(now_ns)
        shown = self._predictions.shown(self._execution.fresh(now_ns))
        self._log_motions(shown, now_ns)
        self._teaching.draw(shown, now_ns)
        self._run.send()
        if self._announcing.due("announcement", None, now_ns):
            self._announce()

    def figures(self) -> tuple[Figure, ...]:
        """Size of the recording so far, and messages that could not be drawn."""
        return (
            Figure("recording_size", float(self._run.parts.size), "B"),
            Figure("unusable_messages", float(self._unusable + self._pictures.undecodable), "1"),
        )

    def close(self) -> None:
        """Finish the file and stop serving."""
        self._run.close()
        self._web.close()

    def _log_depth(self, now_ns: int) -> None:
        cloud, depth = self._cloud.take(now_ns), self._depth.take(now_ns)
        if cloud is not None and self._changes.due("cloud", cloud.data, now_ns):
            scene.log_cloud(self._run, cloud)
        if depth is not None and self._changes.due("depth", depth.data, now_ns):
            if depth_from_wire(depth) is None:
                self._unusable += 1
            else:
                scene.log_depth(self._run, depth)

    def _log_scene(self, now_ns: int) -> None:
        arrangement = self._scene.take(now_ns)
        if arrangement is not None and self._changes.due("environment", arrangement.boxes, now_ns):
            scene.log_environment(self._run, arrangement)
        world, seen = self._world.take(now_ns), self._object.take(now_ns)
        if self._scene.known is None:
            return
        size = self._scene.known.object_size
        if world is not None and any(size) and self._changes.due("truth", _rounded(world.object_pose), now_ns):
            scene.log_object_truth(self._run, world.object_pose, size)
        if seen is not None:
            series.log_object_error(self._run, seen.error)
            if self._changes.due("seen", _rounded(seen.pose), now_ns):
                scene.log_object_seen(self._run, seen.pose, size)

    def _log_motions(self, prediction: Prediction | None, now_ns: int) -> None:
        if prediction is not None and self._changes.due("prediction", prediction, now_ns):
            positions = drawable(prediction.motion.positions)
            deviations = drawable(prediction.deviations)
            if positions is None or deviations is None:
                self._unusable += 1
            else:
                motions.log_prediction(self._run, positions, deviations)
        refined = self._trace.points
        if self._tracing.due("refined", None, now_ns) and self._changes.due("refined", refined.tobytes(), now_ns):
            motions.log_refined(self._run, refined)

    def _log_verdict(self, now_ns: int) -> None:
        verdict = self._verdict.take(now_ns)
        if verdict is None:
            return
        self._words.write(*self._journal.verdict(verdict, now_ns))
        if self._changes.due("collision", verdict.collision_position, now_ns):
            scene.log_collision(self._run, verdict.collision_position, verdict.collision_force)
        known, thing = self._scene.known, self._object_pose()
        if known is not None and self._changes.due("reached", verdict.reached, now_ns):
            scene.log_reached(self._run, known.ellipsoid_radii, reached=verdict.reached)
        if known is None or thing is None:
            return
        centre = vector3(np.subtract(thing.position, verdict.object_displacement).round(3))
        if self._changes.due("kicked over", (verdict.kicked_over, centre), now_ns):
            limits = known.kicked_over_thresholds
            scene.log_kick_limits(self._run, centre, limits, kicked_over=verdict.kicked_over)

    def _object_pose(self) -> Pose | None:
        """Where the object is: the truth where there is one; None where there is no object."""
        if self._scene.known is None or not any(self._scene.known.object_size):
            return None
        if self._world.known is not None:
            return self._world.known.object_pose
        return None if self._object.known is None else self._object.known.pose

    def _announce(self) -> None:
        robot, parts = self._robot.known, self._run.parts
        self._bus.publish(
            RECORDING,
            Recording(
                path=_sendable(str(parts.path)),
                parts=parts.number,
                size=parts.size,
                fault=_sendable(parts.fault),
                viewer_url=self._web.url,
                recording_id=self._run.identity,
                logged_ns=robot.stamp_ns if robot else 0,
            ),
        )


def _sendable(text: str) -> str:
    """The text as a message can hold it: bytes of a path that are no text become question marks."""
    return text.encode(errors="replace").decode()[:_TEXT_LENGTH]


def _rounded(pose: Pose) -> tuple[float, ...]:
    """The pose without what nobody sees."""
    return tuple(round(value, 4) for value in (*pose.position, *pose.orientation))


def _robot_model(stream: Run, known: AnyScene | None) -> RobotModel | None:
    """The robot's shape; a station without the description shows the rest all the same."""
    try:
        arm = known.manipulator if isinstance(known, ReachingScene) else DEFAULT
        return RobotModel((described(known) if known is not None else prepare()).urdf, stream, arm.gripper)
    except (SimError, ImportError) as error:
        log.warning("the robot itself is not shown: %s", error)
        return None
