"""A station without a robot: the real page, fed with made-up views. For the browser tests, and to look at:

python tests/browser/harness.py 8080
"""

import contextlib
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import cv2
import msgspec
import numpy as np
from lessons import history, skills

from lfd.motion.rotations import rotate
from protocol import messages
from protocol.messages import Box, Light, Mode, Phase, Pose
from services.bus.arrays import motion_to_wire, points_to_wire, points_unpacked, to_wire
from services.bus.stages import Stages
from services.process.clock import SystemClock
from services.process.config import StationSection
from services.station.live_view.description import describe
from services.station.live_view.drawing import Criteria, Curve, Drawing, Going, Kick
from services.station.page.login.judge import Judge
from services.station.page.page import Page
from services.station.page.view import PageView, Picture
from sim.robots.catalogue import DEFAULT
from sim.robots.robot import USUAL_CAMERAS
from sim.tasks import DISHWASHER
from sim.tasks.scene import Group

FEED_PERIOD_S = 0.02
GRASP = Pose(tuple(DISHWASHER.start.position), tuple(DISHWASHER.start.orientation))
OBJECT = Pose((0.86, 0.07, 0.553), (1.0, 0.0, 0.0, 0.0))
POINTS_A_BOX = 60
SWING = 0.3  # [rad] of the arm that moves


def described():
    """What the live view shows."""
    return describe(DISHWASHER)


def drawing() -> Drawing:
    """The dishwasher, a prediction in its tube and the half of it that was corrected."""
    predicted, corrected = (DISHWASHER.corridor(variant, np.array(OBJECT.position)) for variant in DISHWASHER.variants)
    points = rows(predicted.positions)
    return Drawing(
        boxes=tuple(
            Box(box.name, box.centre, box.half_sizes, box.quaternion, box.rgba, box.group is not Group.DETAIL)
            for box in DISHWASHER.boxes(DISHWASHER.variants[1])
        ),
        size=DISHWASHER.object_size,
        prediction=Curve(points, tuple((0.03, 0.05, 0.02) for _ in points), rows(predicted.orientations)),
        going=Going(fading=74.0, corrected=True),
        way=rows(corrected.positions)[: len(corrected.positions) // 2],
        criteria=Criteria(DISHWASHER.tolerances),
        kick=Kick(OBJECT.position, DISHWASHER.kick_limits),
    )


def cloud() -> bytes:
    """Points on the boxes, in their colours."""
    random, positions, colours = np.random.default_rng(1), [], []
    for box in drawing().boxes:
        within = random.uniform(-1.0, 1.0, (POINTS_A_BOX, 3))
        within[np.arange(POINTS_A_BOX), random.integers(0, 3, POINTS_A_BOX)] = random.choice((-1.0, 1.0), POINTS_A_BOX)
        positions.append(rotate(np.array(box.orientation), within * box.half_sizes) + box.centre)
        colours.append(np.tile(np.round(255 * np.array(box.rgba[:3])), (POINTS_A_BOX, 1)))
    packed = points_to_wire(np.concatenate(positions), np.concatenate(colours).astype(np.uint8))
    return points_unpacked(packed)


def rows(array):
    """An array as messages have it."""
    return tuple(map(tuple, array.tolist()))


def picture(label: str, width: int = 320, height: int = 240) -> bytes:
    """A JPEG with a gradient and a label."""
    rows, columns = np.mgrid[0:height, 0:width]
    image = np.dstack((columns * 120 // width + 40, rows * 90 // height + 50, np.full_like(rows, 70))).astype(np.uint8)
    cv2.putText(image, label, (12, height - 16), cv2.FONT_HERSHEY_SIMPLEX, 0.6, (230, 230, 230), 1, cv2.LINE_AA)
    return cv2.imencode(".jpg", image)[1].tobytes()


def working_view() -> PageView:
    """Everything there, a refinement under way."""
    return PageView(
        teaching=messages.TeachingState(
            phase="executing",
            text="Correct the motion while it runs; press Space when you are satisfied.",
            light=Light.GREEN,
            refinements=3,
            refinements_allowed=10,
            updates=1,
            updates_allowed=8,
            actions=("finish", "teach"),
        ),
        robot=messages.RobotState(
            joint_names=DEFAULT.joint_names,
            q=tuple(DISHWASHER.posture.tolist()),
            measured=GRASP,
            reference=GRASP,
            phase=Phase.EXECUTE,
            progress=0.0,
            mode=Mode.REFINE,
            offset=(0.0, 0.02, 0.05),
        ),
        robot_age_s=0.008,
        verdict=messages.Verdict(
            reached=False,
            kicked_over=False,
            collision=False,
            ellipsoid_value=3.4,
            missed=0.084,
            object_displacement=(0.002, 0.0, 0.0),
        ),
        safety=messages.SafetyState(emergency_stop=False),
        authority=messages.AuthorityState(holder="station", epoch=4, expires_in=0.9),
        authority_is_mine=True,
        model=messages.ModelState(
            kind="adaptive", version=7, demonstrations=12, updates=1, scene="dishwasher", skill="dishwasher"
        ),
        prediction=messages.Prediction(
            motion=motion_to_wire([[0.5, 0.0, 0.4], [0.8, 0.1, 0.5]], [[1.0, 0.0, 0.0, 0.0]] * 2, 10.0),
            deviations=to_wire([[0.01] * 3] * 2),
            model_version=7,
            object_position=OBJECT.position,
            known=0.6,
            way=messages.Way(1, 2, 0.8),
            skill="dishwasher",
        ),
        history=history(),
        skills=skills(),
        object_pose=messages.ObjectPose(pose=OBJECT, tag=582, error=0.0021, pictures=9),
        drawing=drawing(),
        force=(0.0, 0.0, 2.5),
        master=messages.MasterState(device="keyboard"),
        cameras={"head": Picture(picture("head"), 0.02), "wrist": Picture(picture("wrist"), 0.02, yaw=0.5)},
        cloud=Picture(cloud(), 0.05),
        path=Stages(capture=0.012, way=0.018, apply=0.006, motion=0.020, picture=0.031),
    )


def confirmed_view() -> PageView:
    """The same, where the robot says that it is stopped and stands."""
    return replace(working_view(), safety=messages.SafetyState(emergency_stop=True, by="anna", standing=True))


class Feed:
    """Shows a view again and again, as a station's step does; `view` may be exchanged at any time."""

    def __init__(self, page: Page, view: PageView) -> None:
        self.view = view
        self.moving_pictures = False
        self.moving_robot = False
        self._page = page
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="feed", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def close(self) -> None:
        self._stop.set()
        self._thread.join()

    def _run(self) -> None:
        tick = 0
        while not self._stop.wait(FEED_PERIOD_S):
            tick += 1
            if self.moving_pictures and tick % 3 == 0:
                label = f"{tick}"
                self.view = replace(
                    self.view,
                    cameras={
                        "head": Picture(picture(f"head {label}"), 0.0),
                        "wrist": Picture(picture(f"wrist {label}"), 0.0, yaw=0.5),
                    },
                )
            if self.moving_robot:
                self.view = replace(self.view, robot=swinging(self.view.robot, tick * FEED_PERIOD_S))
            holder = self.view.authority.holder if self.view.authority is not None else ""
            here = msgspec.structs.replace(self._page.attendance(), holder=holder)
            self._page.show(replace(self.view, attendances=(here,)))


def swinging(robot, time_s):
    """The robot's state, its arm somewhere on its way from side to side."""
    torso, shoulder, *others = DISHWASHER.posture.tolist()
    return msgspec.structs.replace(robot, q=(torso, shoulder + SWING * np.sin(2.0 * time_s), *others))


@contextlib.contextmanager
def served(
    *, judge: Judge | None = None, cameras: Sequence[str] = USUAL_CAMERAS, **section: Any
) -> Iterator[tuple[Page, Feed]]:
    """A page that is served, and its feed.

    Args:
        judge: of passwords; None where nobody has to log in.
        cameras: their names.
        section: of the station's configuration.
    """
    page = Page(StationSection(**section), "robot1", SystemClock(), described(), judge=judge, cameras=cameras)
    page.start()
    feed = Feed(page, working_view())
    feed.start()
    yield page, feed
    feed.close()
    page.close()


def main() -> None:
    """Serve until SIGTERM or SIGINT."""
    stop = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: stop.set())
    with served(port=int(sys.argv[1])) as (_, feed):
        feed.moving_pictures = feed.moving_robot = True
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        stop.wait()


if __name__ == "__main__":
    main()
