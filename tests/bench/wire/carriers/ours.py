"""The bus: from `publish` until the message is decoded, judged and stored, so that a step has it.

With certificates the router has the access rules of its register and judges each message by its quotas, as on a real
network, but these are so wide that they turn nothing away.
"""

import contextlib
import sys
import threading
from pathlib import Path

from protocol import topics
from protocol.messages import CameraImage, Pose
from protocol.rights import subject
from services.bus.zenoh import access, connect, open_router
from services.certificates.credentials import Credentials
from services.process.clock import SystemClock
from services.process.runner import SWITCH_INTERVAL_S
from tests.bench.wire.command import MASTER, MOVED, ROBOT
from tests.bench.wire.program import now_ns
from tests.cameras import HEAD_IMAGE

NOWHERE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
SURPLUS = 1000
"""Times a topic's rate until the router's quota turns something away. At the ten of a real network, which is once a
millisecond, it would at 1 kHz turn away what comes early, pass what comes late, and be taken for the bus' delay."""


class Call(threading.Event):
    """Is set where a command is there to be read: notes when that was."""

    def __init__(self, notes):
        super().__init__()
        self.newest = lambda: None
        self._notes = notes

    def set(self):
        came_ns = now_ns()
        self._notes.note(self.newest().message.stamp_ns, came_ns)


class See(threading.Event):
    """The same of a picture."""

    def __init__(self, notes):
        super().__init__()
        self._notes = notes

    def set(self):
        self._notes.see(True)


@contextlib.contextmanager
def routing(settings):
    """Passes on what comes."""
    access.SURPLUS = SURPLUS
    router = open_router(_endpoint(settings), None, _credentials(settings, "router.kitchen"))
    try:
        yield
    finally:
        router.close()


@contextlib.contextmanager
def sending(settings, kind):
    """Sends messages of a kind; of a command only when it is sent."""
    if kind == "command":
        with _connected(settings, "operator.anna", MASTER) as bus:
            yield lambda _: bus.publish(topics.MASTER_STATE, MOVED)
    else:
        with _connected(settings, "camera.kitchen", "camera") as bus:
            yield lambda picture: bus.publish(HEAD_IMAGE, _image(picture))


@contextlib.contextmanager
def receiving(settings, notes):
    """Hands what comes to the notes."""
    call = Call(notes)
    with _connected(settings, "operator.bob", "viewer-bob") as bus:
        call.newest = bus.subscribe(topics.MASTER_STATE, call).latest
        bus.subscribe(HEAD_IMAGE, See(notes))
        yield


@contextlib.contextmanager
def _connected(settings, name, process):
    sys.setswitchinterval(SWITCH_INTERVAL_S)
    bus = connect(_endpoint(settings), ROBOT, process, SystemClock(), credentials=_credentials(settings, name))
    try:
        yield bus
    finally:
        bus.close()


def _endpoint(settings):
    return f"{'tcp' if settings['certificates'] is None else 'tls'}/127.0.0.1:{settings['ports'][0]}"


def _credentials(settings, name):
    folder = settings["certificates"]
    return None if folder is None else Credentials(Path(folder), subject(name))


def _image(data):
    return CameraImage(
        camera="head",
        width=320,
        height=240,
        data=data,
        intrinsics=(1.0, 1.0, 0.0, 0.0),
        pose=NOWHERE,
        captured_ns=now_ns(),
    )
