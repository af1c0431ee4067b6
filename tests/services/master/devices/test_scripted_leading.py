"""The scripted operator leads a robot that nothing else leads: from place to place, or along the way in one go."""

import itertools

import numpy as np
import pytest

from protocol.messages import Light, Method, Mode, OperatorInput, Pose, RobotState, TeachingState
from protocol.topics import OPERATOR_INPUT, ROBOT_STATE, TEACHING_STATE
from services.bus.arrays import quaternion, vector3
from sim.person.itinerary import NEAR
from sim.person.stylus import Stylus
from sim.rotations import rotated, rotation_to
from tests.services.master.devices.site import SAFE, STEADY, Site

pytestmark = pytest.mark.sim

PATIENCE_S = 90.0


class LedSite(Site):
    """A robot in the hand: it goes where the coupled stylus goes, and stands where it is let go."""

    person = STEADY

    def __init__(self, method):
        self.method = method
        self.place, self.turned = self.start.position.copy(), self.start.orientation.copy()
        self.before = None
        super().__init__()

    @property
    def robot(self):
        return self.place

    def publish(self):
        present = OperatorInput(operator="operator", holder="station", epoch=3, present=True)
        self.bus.publish(OPERATOR_INPUT, present)
        pose = Pose(vector3(self.place), quaternion(self.turned))
        state = RobotState(measured=pose, reference=pose, phase=self.phase, mode=Mode.TEACH, episode=self.episode)
        self.bus.publish(ROBOT_STATE, state)
        told = TeachingState(phase="executing", text="", light=Light.GREEN, method=self.method)
        self.bus.publish(TEACHING_STATE, told)

    def tick(self):
        state = super().tick()
        now = None
        if state is not None and state.engaged:
            now = np.array(state.displacement), np.array(state.rotation)
            if self.before is not None:
                self.place = self.place + now[0] - self.before[0]
                self.turned = rotated(self.turned, now[1] - self.before[1])
        self.before = now
        return state

    def lead(self):
        """Until the stylus says that it is done; where waypoints were stored, and every state on the way."""
        stored, states, held = [], [], set()
        while "finish" not in held:
            state = self.tick()
            states.append(state)
            held, before = set(state.actions) if state else set(), held
            if "store" in held - before:
                stored.append(self.place)
            assert self.ticks * 0.01 < PATIENCE_S
        return np.array(stored), [state for state in states if state is not None]


def test_a_waypoint_is_stored_by_the_stylus_button_at_every_place_and_the_last_one_is_the_object():
    site = LedSite(Method.WAYPOINTS)
    stored, _ = site.lead()
    assert len(stored) >= 3
    for place in stored:
        assert np.min(np.linalg.norm(SAFE.positions - place, axis=1)) < 2 * NEAR
    assert np.linalg.norm(stored[-1] - SAFE.positions[-1]) < NEAR
    assert np.linalg.norm(rotation_to(site.turned, SAFE.orientations[-1])) < 0.2


def test_a_demonstration_leads_along_the_way_in_one_go_and_stores_nothing():
    site = LedSite(Method.DEMONSTRATE)
    stored, _ = site.lead()
    assert len(stored) == 0
    assert np.linalg.norm(site.place - SAFE.positions[-1]) < NEAR


def test_where_the_workspace_ends_the_hand_lets_go_comes_back_and_goes_on_and_feels_no_force():
    """The way is longer than the stylus reaches: what it was moved by meanwhile does not count."""
    _, states = LedSite(Method.WAYPOINTS).lead()
    engaged = [state.engaged for state in states]
    assert sum(a and not b for a, b in itertools.pairwise(engaged)) >= 1
    assert max(np.max(np.abs(state.displacement)) for state in states) < Stylus().reach
    assert max(np.linalg.norm(state.force) for state in states[50:]) == 0.0
