"""Says where the object is, from a camera's pictures, each of them once.

While the arm hides the marker nothing is published: the pose's age says so, a repeated one would not.
"""

from __future__ import annotations

import math
from collections import deque
from statistics import median

import cv2

from protocol.messages import CameraImage, Coding, Figure, ObjectPose, PictureQueue, Pose
from protocol.topics import CAMERA_IMAGE, OBJECT_POSE, PICTURE_QUEUE
from services.bus.arrays import quaternion, vector3
from services.bus.bus import Bus
from services.bus.picture_stream import PictureStream
from services.perception.filter import PoseFilter
from services.perception.placement import Matrix, placement, quaternion_from_rotation
from services.perception.tags import Picture, TagFinder, Tagged, candidates, choose, decode
from services.process.clock import Clock
from services.process.config import Configuration, PerceptionSection
from services.process.robots import check_camera, known_scene
from services.process.runner import Service
from services.process.schedule import Schedule
from services.video.decoder import Decoder
from sim.tasks.reaching import ReachingScene
from sim.tasks.thing import Thing

RATE_HZ = 30.0

_LARGEST_ERROR = 1e9  # [m] as large as a message's number may be


def build(bus: Bus, clock: Clock, configuration: Configuration) -> Service:
    """The perception process.

    Raises:
        UnusableSetting: the camera by which it is to see is not there.
    """
    check_camera("[perception] camera", configuration.perception.camera, configuration)
    # Threads for pictures this small cost more than they give, and take the other processes' cores.
    cv2.setNumThreads(1)
    known = known_scene(configuration.robot)
    thing = known.target if isinstance(known, ReachingScene) else None
    return PerceptionService(bus, clock, configuration.perception, thing)


class PerceptionService:
    """From the newest picture of a camera to the object's pose.

    Args:
        bus: to the robot's other processes.
        clock: what durations are measured on.
        section: by which camera it sees, and over how many pictures the pose is filtered.
        thing: whose pose it is; None where no task is known that has one.
    """

    def __init__(self, bus: Bus, clock: Clock, section: PerceptionSection, thing: Thing | None = None) -> None:
        self._bus = bus
        self._clock = clock
        self._images = PictureStream(bus.subscribe(CAMERA_IMAGE.of(section.camera)))
        self._decoder = Decoder()
        self._schedule = Schedule()
        self._tagged = Tagged.of(thing)
        self._finder = TagFinder(self._tagged.tag)
        self._filter = PoseFilter(section.window)
        self._previous: Matrix | None = None
        self._seen = (0, 0)
        self._durations_ns: deque[int] = deque(maxlen=256)
        self._undecodable = self._without_tag = self._without_pose = self._flips = 0
        self._error = -1.0

    @property
    def rate_hz(self) -> float:
        """Twice the cameras': a picture waits half a period at most."""
        return RATE_HZ

    def step(self, now_ns: int) -> None:
        """Process the newest picture, once."""
        image = self._images.fresh(now_ns)
        self._ask(now_ns)
        if image is None or (image.publisher, image.sequence) == self._seen:
            return
        self._seen = (image.publisher, image.sequence)
        base_from_object = self._locate(image)
        if base_from_object is not None:
            self._publish(base_from_object, image)
        self._durations_ns.append(self._clock.now_ns() - now_ns)

    def figures(self) -> tuple[Figure, ...]:
        """Duration of a picture since the last call, the newest error, and what was no use, so far."""
        result = (
            Figure("picture_p50", median(self._durations_ns or (0,)) / 1e9, "s"),
            Figure("pose_error", self._error, "m"),
            Figure("undecodable_pictures", float(self._undecodable), "1"),
            Figure("pictures_without_tag", float(self._without_tag), "1"),
            Figure("tags_without_pose", float(self._without_pose), "1"),
            Figure("rejected_flips", float(self._flips), "1"),
        )
        self._durations_ns.clear()
        return result

    def close(self) -> None:
        """Nothing to give back."""

    def _ask(self, now_ns: int) -> None:
        """For pictures that can be decoded here, where they cannot; how late they come is others' to tell."""
        waits = self._images.waits or self._decoder.waits
        if (waits or not self._decoder.is_able) and self._schedule.due(PICTURE_QUEUE, now_ns):
            self._bus.publish(PICTURE_QUEUE, PictureQueue(waits=waits, jpeg_only=not self._decoder.is_able))

    def _picture(self, image: CameraImage) -> Picture | None:
        return decode(image.data) if image.coding is Coding.JPEG else self._decoder.grey(self._images.group)

    def _locate(self, image: CameraImage) -> Matrix | None:
        picture = self._picture(image)
        if picture is None:
            self._undecodable += 1
            return None
        corners = self._finder.find(picture)
        if corners is None:
            self._without_tag += 1
            return None
        base_from_camera = placement(image.pose.position, image.pose.orientation)
        choice = choose(candidates(corners, image.intrinsics, base_from_camera, self._tagged), self._previous)
        if choice is None:
            self._without_pose += 1
            return None
        self._flips += choice.flipped
        self._previous = choice.base_from_object
        return self._filter.update(choice.base_from_object)

    def _publish(self, base_from_object: Matrix, image: CameraImage) -> None:
        position = base_from_object[:3, 3]
        truth = image.object_pose
        self._error = -1.0 if truth is None else min(math.dist(position, truth.position), _LARGEST_ERROR)
        self._bus.publish(
            OBJECT_POSE,
            ObjectPose(
                pose=Pose(vector3(position), quaternion(quaternion_from_rotation(base_from_object[:3, :3]))),
                tag=self._tagged.tag.id,
                error=self._error,
                rejected=self._flips,
                pictures=len(self._filter),
            ),
        )
