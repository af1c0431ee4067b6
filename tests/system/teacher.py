"""A person at the page who leads the robot by hand: sees where the gripper is, holds the keys that lead on."""

import contextlib
import time

import numpy as np
from playwright.sync_api import TimeoutError as NotThere

from protocol import topics
from protocol.messages import Mode, Phase

KEYS = (("q", "a"), ("w", "s"), ("e", "d"))
NEAR_M = 0.008
"""So near to where it is to be the gripper is there."""

SPEED = 0.12
"""Of the gripper while a key is held [m/s]."""

LONGEST_MS, SHORTEST_MS = 2000, 30
"""For which a key is held before the next look."""

SHOWN = "[document.body.matches('[data-let-go]'), document.querySelector('[data-action=go_on]:enabled') !== null]"
"""Whether the page says to let go of the keys, and whether it asks to go on: one look, not one for each."""

LOOK_MS = 20
LEADS_S = 180.0
HEARD_S = 3.0
DECIDES_S = 120.0


class Teacher:
    """See the module.

    Args:
        page: the browser's page.
        witness: of the robot's network, in place of eyes.
    """

    def __init__(self, page, witness):
        self._page = page
        self._witness = witness
        self._seen = witness.bus.subscribe(topics.OBJECT_POSE)

    def press(self, action, argument="", seen=None):
        """Press a button of the page until it counts; again where the press came too late to be done.

        Args:
            action: its name.
            argument: what it is about.
            seen: whether it counts; where nothing is said, that the robot is not waited with any more.
        """
        about = f"[data-argument='{argument}']" if argument else ":not([data-argument])"
        button = self._page.locator(f"[data-action={action}]{about}:enabled")
        before = self._witness.teaching
        # What the model does at once may be over before anybody looks.
        moved_on = seen or (lambda: self._taught(lambda now: now.phase != "deciding" or now.event != before.event))
        pressed = seen is not None

        def counts():
            return pressed and moved_on()

        deadline = time.monotonic() + DECIDES_S
        while not counts():
            assert time.monotonic() < deadline, f"{action} does not count; {self._witness.teaching}"
            with contextlib.suppress(NotThere):
                button.click(timeout=HEARD_S * 1e3)
                pressed = True
            with contextlib.suppress(AssertionError):
                self.until(counts, HEARD_S, action)

    def choose(self, method):
        """Choose how to teach."""
        self.press("method", method, lambda: self._taught(lambda teaching: teaching.method.value == method))

    def _taught(self, says):
        teaching = self._witness.teaching
        return teaching is not None and says(teaching)

    def until(self, seen, within_s, what):
        """Look on until something is seen; what `seen()` says. The browser lives on meanwhile."""
        deadline = time.monotonic() + within_s
        while not (value := seen()):
            if time.monotonic() > deadline:
                raise AssertionError(f"not within {within_s:g} s: {what}; {self._witness.teaching}")
            self._page.wait_for_timeout(LOOK_MS)
        return value

    def decides(self, attempts=0):
        """What the page says as it asks the operator, after so many episodes; a motion that has held goes on."""

        def asked():
            teaching = self._witness.teaching
            told = teaching is not None and teaching.phase == "deciding" and teaching.recommended
            if told and len(teaching.attempts) >= attempts:
                return teaching
            self._go_on()
            return None

        return self.until(asked, DECIDES_S, "the operator is asked")

    def object_seen(self):
        """Where the camera sees the object, shape (3,) [m]."""
        received = self.until(self._seen.latest, DECIDES_S, "the object is seen")
        return np.array(received.message.pose.position)

    def take_up(self):
        """Press for the robot to be led until it follows: what is lost on the way is asked for again."""
        self.press("lead", seen=self._follows)

    def lead_to(self, place):
        """Hold keys until the gripper is at a place, shape (3,) [m]."""
        self.until(lambda: self._is_led(place), LEADS_S, f"the gripper is at {place}")

    def store(self, place):
        """Lead to a place and store it as a waypoint."""
        self.lead_to(place)
        before = len(self.until(lambda: self._witness.teaching, DECIDES_S, "the station is heard").waypoints)
        self.press("store", seen=lambda: self._taught(lambda teaching: len(teaching.waypoints) > before))

    def done(self):
        """Space: the motion ends here."""
        self._page.keyboard.press("Space")
        self.until(lambda: not self._follows(), DECIDES_S, "the motion has ended")

    def _follows(self):
        robot = self._witness.robot
        return robot is not None and robot.mode is Mode.TEACH and robot.phase is Phase.EXECUTE

    def _is_led(self, place):
        """Whether the gripper is there; else hold the key for as long as the longest of its three ways takes."""
        robot = self._witness.robot
        if robot is None or self._is_asked():
            return False
        away = place - np.array(robot.measured.position)
        axis = int(np.argmax(np.abs(away)))
        if abs(away[axis]) <= NEAR_M:
            return True
        key = KEYS[axis][0 if away[axis] > 0.0 else 1]
        self._page.keyboard.press(key, delay=np.clip(1e3 * abs(away[axis]) / SPEED, SHORTEST_MS, LONGEST_MS))
        return False

    def _is_asked(self):
        """Whether the page asks for something else than to lead: to let go of the keys, or to go on."""
        let_go, asked = self._page.evaluate(SHOWN)
        if asked:
            self._go_on()
        return let_go or asked

    def _go_on(self):
        """Where the page asks for it: a page that came too late, on a busy computer, has let the robot hold."""
        button = self._page.locator("[data-action=go_on]:enabled")
        # The robot may not ask any more by now.
        with contextlib.suppress(NotThere):
            if button.count():
                button.click(timeout=1e3)
