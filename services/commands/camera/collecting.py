"""Pictures of the board and the robot's poses, taken while somebody leads the robot about."""

from __future__ import annotations

import tempfile
import threading
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np

from lfd.motion.rotations import conjugate, log_map, multiply, rotate
from protocol.messages import CameraImage, Coding, PictureQueue, RobotState
from protocol.topics import CAMERA_IMAGE, PICTURE_QUEUE, ROBOT_STATE
from services.bus.arrays import Floats
from services.bus.bus import Bus
from services.bus.zenoh import connect
from services.camera.calibration.board import Board
from services.camera.calibration.views import write_view
from services.certificates.credentials import credentials
from services.commands.camera.eyes import Eye
from services.process.clock import Clock, SystemClock
from services.process.config import Configuration
from services.process.exceptions import CommandFailed
from services.process.files import make_folder
from services.process.robots import scene_of
from services.process.runner import stop_on_signals
from services.process.schedule import Schedule
from sim.tasks import described
from sim.tasks.reaching import ReachingScene
from sim.world.links import Links

STILL = 0.01
"""Of every joint [rad/s]: a robot that is slower stands."""

STOOD_NS = 400_000_000
"""It has stood for so long before a picture counts."""

APART_M, APART_RAD = 0.03, 0.12
"""By one of these a pose is another one."""

STEP_S = 0.05
NOTHING_S = 15.0
"""After so long without a picture or a state nothing is waited for any more."""


class Collector:
    """Takes a picture in each new pose in which the robot stands and the board is seen.

    Args:
        bus: to the robot.
        eye: the camera.
        board: that it sees.
        links: of the robot.
        last: its last joint, which moves the hand.
        folder: for the pictures.

    Attributes:
        taken: how many pictures there are.
    """

    def __init__(self, bus: Bus, eye: Eye, board: Board, links: Links, *, last: str, folder: Path) -> None:
        self.taken = 0
        self._bus, self._eye, self._board, self._links, self._folder = bus, eye, board, links, folder
        self._hand = "" if eye.link and links.carries(last, eye.link) else links.hand(last)
        self._images = bus.subscribe(CAMERA_IMAGE.of(eye.name))
        self._robot = bus.subscribe(ROBOT_STATE)
        self._schedule = Schedule()
        self._stood_ns: int | None = None
        self._poses: list[tuple[Floats, Floats]] = []

    @property
    def held(self) -> bool:
        """The hand has to hold the board; else it lies still and the hand carries the camera."""
        return bool(self._hand)

    def silent(self, now_ns: int) -> str:
        """Which process is not heard; empty where both are."""
        if self._robot.fresh(now_ns) is None:
            return "robot"
        return "" if self._images.fresh(now_ns) is not None else "camera"

    def step(self, now_ns: int) -> int | None:
        """Look; how many corners a picture shows that was taken now, None where none was."""
        if self._schedule.due(PICTURE_QUEUE, now_ns):
            self._bus.publish(PICTURE_QUEUE, PictureQueue(jpeg_only=True))
        state, image = self._robot.fresh(now_ns), self._images.fresh(now_ns)
        if state is None or not _stands(state):
            self._stood_ns = None
            return None
        self._stood_ns = self._stood_ns or state.stamp_ns
        if image is None or image.coding is not Coding.JPEG or image.captured_ns < self._stood_ns + STOOD_NS:
            return None
        position, orientation = pose = self._pose(state)
        if not all(_apart(pose, other) for other in self._poses):
            return None
        corners = self._board.find(_grey(image))
        if corners is None:
            return None
        self._poses.append(pose)
        self.taken += 1
        write_view(self._folder, self.taken, image.data, (*position.tolist(), *orientation.tolist()))
        return len(corners.places)

    def _pose(self, state: RobotState) -> tuple[Floats, Floats]:
        """Of the camera's link where the board stands still: in the base's frame, or the hand's where that holds it."""
        joints = dict(zip(state.joint_names, state.q, strict=False))
        at = self._links.pose(self._eye.link or "world", joints)
        if not self._hand:
            return at.position, at.orientation
        hand = self._links.pose(self._hand, joints)
        back = conjugate(hand.orientation)
        return rotate(back, at.position - hand.position), multiply(back, at.orientation)


def collect(
    chosen: Configuration,
    eye: Eye,
    board: Board,
    *,
    count: int,
    keep: Path | None,
    tell: Callable[[str], object],
) -> Path:
    """Take so many pictures of a running robot's camera; the folder that they are in.

    Args:
        chosen: whose.
        eye: the camera.
        board: that it sees.
        count: of pictures.
        keep: folder for them; None for one that is temporary.
        tell: a person how it goes.

    Raises:
        CommandFailed: the scene has no arm, nothing is heard of it, or there is something in the folder.
    """
    if keep is not None and keep.exists() and any(keep.iterdir()):
        raise CommandFailed(f"there is something in {keep}: name a folder that is empty, or --from for what is in it")
    scene = scene_of(chosen.robot)
    if not isinstance(scene, ReachingScene):
        raise CommandFailed(f"there is no arm in scene {scene.name} to be led about")
    clock, stop = SystemClock(), stop_on_signals()
    shown = credentials(chosen, chosen.connect, "cli")
    name = shown.process("cli") if shown is not None else "cli"
    bus = connect(chosen.connect, chosen.name, name, clock, credentials=shown)
    folder = keep or Path(tempfile.mkdtemp(prefix="retouch-camera-"))
    make_folder(folder)
    links, last = Links(scene, described(scene)), scene.manipulator.joint_names[-1]
    try:
        collector = Collector(bus, eye, board, links, last=last, folder=folder)
        tell("the hand holds the board" if collector.held else "the board lies still, the hand carries the camera")
        _collect(collector, count, clock, stop, tell)
    finally:
        bus.close()
    return folder


def _collect(
    collector: Collector, count: int, clock: Clock, stop: threading.Event, tell: Callable[[str], object]
) -> None:
    heard_ns = clock.now_ns()
    while collector.taken < count and not stop.wait(STEP_S):
        now_ns = clock.now_ns()
        corners = collector.step(now_ns)
        silent = collector.silent(now_ns)
        heard_ns = heard_ns if silent else now_ns
        if now_ns - heard_ns > NOTHING_S * 1e9:
            raise CommandFailed(f"nothing is heard of the {silent} for {NOTHING_S:g} s: start it, and calibrate again")
        if corners is not None:
            tell(f"{collector.taken} of {count}: {corners} corners; now another pose")


def _stands(state: RobotState) -> bool:
    return all(abs(speed) < STILL for speed in state.qd)


def _apart(one: tuple[Floats, Floats], other: tuple[Floats, Floats]) -> bool:
    turn = log_map(multiply(conjugate(one[1]), other[1]))
    return bool(np.linalg.norm(one[0] - other[0]) > APART_M or np.linalg.norm(turn) > APART_RAD)


def _grey(image: CameraImage) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    picture = cv2.imdecode(np.frombuffer(image.data, np.uint8), cv2.IMREAD_GRAYSCALE)
    return np.zeros((1, 1), np.uint8) if picture is None else np.asarray(picture, np.uint8)
