"""The topics of a robot that sees with a head and a wrist camera."""

from protocol import topics
from protocol.topics import CAMERA_IMAGE
from sim.robots.robot import USUAL_CAMERAS

HEAD_IMAGE, WRIST_IMAGE = IMAGES = tuple(CAMERA_IMAGE.of(name) for name in USUAL_CAMERAS)

TOPICS = (*(topic for topic in topics.TOPICS if topic is not CAMERA_IMAGE), *IMAGES)
"""Each of them, the cameras' by their names."""
