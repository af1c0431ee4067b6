"""A person who corrects a motion while it runs, at a page or a frame of one: looks at robot and page, and leads."""

import contextlib

import numpy as np
from playwright.sync_api import TimeoutError as NotThere

from protocol import topics
from protocol.messages import Mode, Phase
from services.bus.arrays import motion_from_wire
from services.bus.predictions import Predictions
from sim.person.intention import plan
from sim.tasks import DISHWASHER

EPISODE_S = 120.0
SHOWN = """[document.body.matches('[data-let-go]') || document.querySelector('.device-trouble').textContent !== '',
    document.querySelector('[data-action=go_on]:enabled') !== null]"""
"""Whether the page says to let go, and whether it asks to go on: one look, not one for each."""

LEAD = 0.03
"""A person looks a little ahead: share of the motion."""


class Person:
    """Looks at where the robot is and where it should be, leads it there, and lets it go on if it asks.

    Args:
        page: the browser's page.
        hand: on a device.
        witness: of the robot's network, in place of eyes.
    """

    def __init__(self, page, hand, witness):
        self._page = page
        self._witness = witness
        self._predictions = Predictions(witness.bus)
        self._execution = witness.bus.subscribe(topics.EXECUTION)
        self._seen = witness.bus.subscribe(topics.OBJECT_POSE)
        self._hand = hand
        self._correction = None

    def begin(self):
        """Another motion to correct."""
        self._correction = None

    def look(self):
        """One look, and what it calls for: to lead, or to let go, or to go on."""
        robot = self._witness.robot
        let_go, asked = self._page.evaluate(SHOWN)
        if let_go:
            self._hand.rest()
            return
        if asked:
            self._hand.rest()
            # The robot may not ask any more by now.
            with contextlib.suppress(NotThere):
                press(self._page, "go_on", within_s=1.0)
            return
        if robot is None or robot.mode is not Mode.REFINE or robot.phase is not Phase.EXECUTE:
            self._hand.rest()
            return
        wanted = self._wanted(robot.progress)
        if wanted is None:
            return
        self._hand.steer(wanted, np.array(robot.offset))

    def _wanted(self, progress):
        if self._correction is None:
            received, seen = self._execution.latest(), self._seen.latest()
            if received is None or received.message.mode is not Mode.REFINE or seen is None:
                return None
            place = np.array(seen.message.pose.position)
            ways = [DISHWASHER.corridor(variant, place) for variant in DISHWASHER.variants]
            predicted = self._predictions.motion(received.message.prediction)
            if predicted is None:
                return None
            positions, orientations, *_ = motion_from_wire(predicted)
            self._correction = plan(positions, orientations, ways[1], ways)
        return self._correction.displacement(min(1.0, progress + LEAD))


def press(page, action, within_s=EPISODE_S):
    """Press a button of the page once it is offered."""
    page.locator(f"[data-action={action}]:enabled").click(timeout=within_s * 1e3)


def decides(page, witness, attempts):
    """The workflow that waits for the operator after so many episodes, or None; the browser lives on meanwhile."""
    page.wait_for_timeout(20)
    teaching = witness.teaching
    waits = teaching is not None and teaching.phase == "deciding" and len(teaching.attempts) >= attempts
    return teaching if waits else None
