"""What the tests of this folder show."""

from protocol.messages import Light, TeachingState
from services.station.page.standing import Standing
from services.station.page.view import PageView, Shown

SEATED = Standing(
    armed=True,
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


def shown(**view):
    return Shown(PageView(**view), 0.0)
