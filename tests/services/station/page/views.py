"""What the tests of this folder show."""

from protocol.messages import Light, Pose, RobotState, TeachingState
from services.station.page.standing import Standing
from services.station.page.view import PageView, Shown

SEATED = Standing(
    armed=True,
    vacant=False,
    let_go=False,
    heard=True,
    focused=True,
    asked_s=0.0,
    asking_s=0.0,
    kept=False,
    stop_pressed=False,
    accepted=(),
    refused=(),
)


def teaching(light=Light.GREEN, phase="executing", **more):
    return TeachingState(phase=phase, text="so it is", light=light, **more)


POSE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))


def robot(phase, episode=1, **more):
    return RobotState(measured=POSE, reference=POSE, phase=phase, episode=episode, **more)


def shown(clamped=(), **view):
    return Shown(PageView(**view), 0.0, clamped)
