"""Between the arm and its backend: what stopped by itself stops the robot; what it does not know the camera says."""

from dataclasses import replace

import numpy as np
import pytest

from protocol import messages, topics
from services.robot.backends.backend import NotReady, State, Status
from tests.services.robot.site import Site

FALLEN = Status(State.PROTECTIVE_STOP, 0.002, "it met something")


@pytest.fixture
def site():
    site = Site()
    site.acquire()
    return site


def test_an_arm_whose_own_controller_stopped_it_is_stopped_with_its_reason(site, monkeypatch):
    site.execute()
    site.run(0.8)
    monkeypatch.setattr(site.arm._backend, "status", lambda: FALLEN)
    site.run(0.05)
    assert site.safety.emergency_stop
    assert "protective stop: it met something" in site.safety.reason
    assert (site.safety.backend, site.safety.backend_age) == ("protective stop", 0.002)
    assert not site.result.completed


def test_a_stop_is_released_only_where_the_arm_can_follow_again(site, monkeypatch):
    site.press()

    def fail():
        raise NotReady(Status(State.HARDWARE_STOP, 0.0, "its button is pressed"))

    with monkeypatch.context() as pressed:
        pressed.setattr(site.arm._backend, "recover", fail)
        assert "its button is pressed" in site.release().reason
        site.run(0.1)
        assert site.safety.emergency_stop
    site.release()
    site.run(0.1)
    assert not site.safety.emergency_stop


def test_while_it_is_stopped_the_arm_is_not_commanded(site, monkeypatch):
    commanded = []
    monkeypatch.setattr(site.arm._backend, "command", lambda *command: commanded.append(command))
    site.press()
    commanded.clear()
    site.run(0.1)
    assert not commanded
    assert "smoke" in site.arm._backend.status().reason
    site.release()
    site.run(0.02)
    assert commanded


def test_where_the_backend_does_not_know_the_object_it_is_where_the_camera_saw_it(site, monkeypatch):
    observe = site.arm._backend.observe
    monkeypatch.setattr(site.arm._backend, "observe", lambda: replace(observe(), object_pose=None, world=np.zeros(0)))
    worlds = site.operator.subscribe(topics.WORLD_STATE)
    site.run(0.1)
    assert site.arm.observation.object_pose is None
    assert not worlds.take(), "hardware knows nothing of the world around it"
    seen = messages.Pose((0.4, 0.1, 0.0), (1.0, 0.0, 0.0, 0.0))
    site.operator.publish(topics.OBJECT_POSE, messages.ObjectPose(pose=seen, tag=1, error=0.0, pictures=1))
    site.run(0.05)
    np.testing.assert_allclose(site.arm.observation.object_pose.position, seen.position)
