"""What a station tells of its operator's own way from hand to eye, and what it leaves open."""

import pytest

from protocol import topics
from protocol.messages import AuthorityState, CameraImage, MasterState, OperatorInput, Phase, Pose, RobotState
from services.bus.identity import new_publisher
from services.bus.memory import MemoryNetwork
from services.bus.outbox import Outbox
from services.bus.stages import Stages, from_figures
from services.process.clock import ManualClock
from services.station.ears import Ears
from services.station.own_path import OwnPath
from tests.cameras import HEAD_IMAGE

MS = 1_000_000
POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
MINE = AuthorityState(holder="station-1", epoch=41, expires_in=1.0)
BOBS = AuthorityState(holder="station-2", epoch=42, expires_in=1.0)
AHEAD_NS = 90_000_000_000_000
"""By which the robot's machine has been on for longer than the desk."""


class Desk:
    """A station beside its master, and a robot here or far away."""

    def __init__(self, *, far):
        self.clock = ManualClock(10**12)
        self._network = MemoryNetwork(self.clock)
        bus = self._network.bus("station")
        self.far, self._ahead_ns = far, AHEAD_NS if far else 0
        own = bus.identity
        there = own ^ (1 << 50) if far else own
        self._robot, self._camera = Outbox(there, "robot1", "robot"), Outbox(there + 1, "robot1", "camera")
        self._master = Outbox(own + 1, "robot1", "master")
        self.ears = Ears(bus)
        self.path = OwnPath(self.ears, own, "station-1")

    def say(self, sender, topic, message, stamp_ns):
        self._network.deliver(topic, sender.pack(topic, message, stamp_ns), topic.schema)

    def hear(self, authority=MINE, ahead=True, **robot):
        """All of them say something now."""
        self.clock.advance(0.01)
        now = self.clock.now_ns()
        told = {"applied_latency": 0.024, "applied_way": 0.018, "following_lag": 0.02} | robot
        ahead_s = self._ahead_ns / 1e9 if ahead else None
        state = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, ahead=ahead_s, **told)
        self.say(self._robot, topics.ROBOT_STATE, state, now + self._ahead_ns)
        self.say(self._robot, topics.AUTHORITY_STATE, authority, now + self._ahead_ns)
        master = MasterState(holder=authority.holder, epoch=authority.epoch, capture=0.012)
        self.say(self._master, topics.MASTER_STATE, master, now)

    def see(self, captured_ms_ago, sent_ms_ago):
        """A picture comes now."""
        there = self.clock.now_ns() + self._ahead_ns
        shown = CameraImage(
            camera="head", width=1, height=1, data=b"x", intrinsics=(1.0,) * 4, pose=POSE,
            captured_ns=there - captured_ms_ago * MS,
        )  # fmt: skip
        self.say(self._camera, HEAD_IMAGE, shown, there - sent_ms_ago * MS)
        return self.path.picture(self.ears.cameras["head"], self.clock.now_ns())

    def stages(self, authority=MINE):
        return self.path.stages(authority, self.ears.robot.latest().message, self.clock.now_ns())


@pytest.fixture(params=[False, True], ids=["one machine", "two machines"])
def desk(request):
    return Desk(far=request.param)


def test_the_whole_way_of_who_commands(desk):
    desk.hear()
    assert desk.path.seen(OperatorInput(drawn=0.031)).drawn == 0.031
    assert desk.stages() == Stages(0.012, 0.018, pytest.approx(0.006), 0.02, 0.031)


def test_what_was_measured_stays_shown_for_seconds_and_not_for_ever(desk):
    desk.hear()
    desk.path.seen(OperatorInput(drawn=0.031))
    whole = desk.stages()
    desk.clock.advance(4.0)
    desk.hear(following_lag=-1.0)
    assert desk.stages() == whole, "an arm that stands"
    desk.clock.advance(4.0)
    desk.hear(following_lag=-1.0)
    assert desk.stages().motion is None


def test_while_another_one_commands_only_what_comes_back_is_ones_own(desk):
    desk.hear(authority=BOBS)
    desk.path.seen(OperatorInput(drawn=0.031))
    assert desk.stages(BOBS).known == (0.031,)
    assert desk.stages(None).known == (0.031,)


def test_a_picture_is_as_old_as_what_it_shows_wherever_its_camera_stands(desk):
    desk.hear()
    assert desk.see(captured_ms_ago=80, sent_ms_ago=45).age_s == pytest.approx(0.080)


def test_where_the_clocks_do_not_compare_nobody_knows_how_old_a_drawn_picture_is():
    desk = Desk(far=True)
    desk.hear(ahead=False)
    assert desk.path.seen(OperatorInput(drawn=0.031)).drawn == -1.0
    assert desk.stages().picture is None
    assert desk.see(captured_ms_ago=80, sent_ms_ago=45).age_s == pytest.approx(0.035), "what passed at the robot"


def test_another_persons_master_says_nothing_of_this_machines_clock():
    desk = Desk(far=True)
    desk._master = Outbox(new_publisher() ^ (1 << 52), "robot1", "master-bob")
    desk.hear(authority=BOBS)
    assert desk.ears.robot_clock(desk.path._own) is None


def test_the_heartbeat_tells_what_this_process_alone_knows(desk):
    desk.hear()
    assert desk.path.figures() == ()
    desk.path.seen(OperatorInput(drawn=0.031))
    assert from_figures(desk.path.figures()) == Stages(picture=0.031)
