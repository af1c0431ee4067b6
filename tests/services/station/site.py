"""A station on the memory bus, and whom it talks to."""

from dataclasses import replace

import msgspec

from protocol import queries, topics
from protocol.messages import (
    Attendance,
    AuthorityState,
    Figure,
    ModelState,
    ObjectPose,
    OperatorInput,
    Person,
    Phase,
    Pose,
    RobotState,
    Role,
    SceneState,
)
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.station.page.effects import Effects
from services.station.press import Press
from services.station.service import StationService
from tests.services.station.workflow import site as workflow

POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
REGION = ((0.8, -0.1, 0.5), (0.9, 0.1, 0.5))
BY_HAND = replace(workflow.BY_HAND, holder="station-1")
SETTINGS = replace(BY_HAND, scripted=True)


class Tab:
    """Stands in for the browser's page: what it says was pressed and held."""

    def __init__(self):
        self.jpeg_only = False
        self.pressed = []
        self.held = OperatorInput(keys=("KeyE",), focused=True, present=True)
        self.shown = None
        self.closed = False
        self.effects = Effects()

    def take_presses(self):
        taken, self.pressed = self.pressed, []
        return [press if isinstance(press, Press) else Press(press) for press in taken]

    def take_input(self):
        return self.held

    def attendance(self):
        return Attendance(holder="", people=(Person("ann", Role.OPERATOR, has_input=True),))

    def show(self, view):
        self.shown = view

    def figures(self):
        return (Figure("pictures", 25.0, "Hz"),)

    def close(self):
        self.closed = True


class Site:
    """A station, and a robot and a model that are there."""

    def __init__(self, page=None, *, settings=SETTINGS):
        self.clock = ManualClock()
        network = MemoryNetwork(self.clock)
        self.other = network.bus()
        self.acquire = self.other.serve(queries.ACQUIRE)
        self.reset = self.other.serve(queries.RESET)
        self.applied_latency = -1.0
        self.robot = RobotState(measured=POSE, reference=POSE, phase=Phase.IDLE)
        self.authority = AuthorityState(holder="", epoch=40, expires_in=0.0)
        self.service = StationService(network.bus(), settings, page, seed=3)

    def run(self, seconds):
        for _ in range(round(seconds * self.service.rate_hz)):
            self.clock.advance(1.0 / self.service.rate_hz)
            applied = {"applied_latency": self.applied_latency, "applied_way": 0.8 * self.applied_latency}
            self.other.publish(topics.ROBOT_STATE, msgspec.structs.replace(self.robot, **applied))
            self.other.publish(
                topics.MODEL_STATE, ModelState(kind="adaptive", version=1, demonstrations=1, updates=0, scene="s")
            )
            self.other.publish(topics.AUTHORITY_STATE, self.authority)
            self.service.step(self.clock.now_ns())

    def show_scene(self, **changes):
        scene = SceneState(
            name="s",
            variant="b1",
            boxes=(),
            object_size=(0.05, 0.05, 0.1),
            ellipsoid_radii=(0.05, 0.05, 0.05),
            kicked_over_thresholds=(0.1, 0.1, 0.1),
            start=POSE,
            object_region=REGION,
            variants=("b1", "b2"),
        )
        self.other.publish(topics.SCENE_STATE, msgspec.structs.replace(scene, **changes))

    def grant(self, **scene):
        self.show_scene(**scene)
        self.run(0.1)
        (call,) = self.acquire.take()
        call.reply(queries.AuthorityGranted(41, 1.0))
        self.authority = AuthorityState(holder=call.request.holder, epoch=41, expires_in=1.0)

    def see(self, seconds):
        """Let the object be seen for so long."""
        for _ in range(round(seconds * self.service.rate_hz)):
            self.other.publish(topics.OBJECT_POSE, ObjectPose(pose=POSE, tag=1, pictures=9))
            self.run(1.0 / self.service.rate_hz)


def spied(target, name, monkeypatch):
    """What is given to a function from now on."""
    given, function = [], getattr(target, name)
    monkeypatch.setattr(target, name, lambda *values: (given.append(values), function(*values))[1])
    return given
