"""A person's hand at each device of the page: it is told what correction is wanted, and which is applied."""

TOLERANCE_M = 0.008
AXES = (("q", "a"), ("w", "s"), ("e", "d"))
REACH_M = 0.25
NOTCH_M = 0.05 * REACH_M
"""By which the pointer's wheel moves with each notch, of a hundred pixels."""

CALM = 0.06
"""Share of what is left that a dragging hand does at each look: the robot follows a moment later."""

GAMEPAD = """
    window.axes = [0, 0, 0, 0];
    navigator.getGamepads = () => [{index: 0, id: 'Pad (STANDARD GAMEPAD)', mapping: 'standard', connected: true,
        timestamp: 1, axes: window.axes, buttons: Array.from({length: 17}, () => ({value: 0, pressed: false}))}];
"""


class OnKeys:
    """Holds the keys that lead there."""

    script = ""
    device = "keyboard"

    def __init__(self, page):
        self._page = page
        self._held = set()

    def steer(self, wanted, applied):
        """Lead from the correction that is applied to the one that is wanted, in base axes [m]."""
        error = wanted - applied
        self._hold({AXES[i][0 if error[i] > 0.0 else 1] for i in range(3) if abs(error[i]) > TOLERANCE_M})

    def rest(self):
        """Let go of everything."""
        self._hold(set())

    def _hold(self, keys):
        for key in self._held - keys:
            self._page.keyboard.up(key)
        for key in keys - self._held:
            self._page.keyboard.down(key)
        self._held = keys


class Simulated:
    """A stylus that the master's own simulated hand holds: the person only presses."""

    def steer(self, wanted, applied):
        """See `OnKeys`."""

    def rest(self):
        """See `OnKeys`."""


class OnGamepad:
    """Deflects the sticks that lead there."""

    script = GAMEPAD
    device = "gamepad"

    def __init__(self, page):
        self._page = page

    def steer(self, wanted, applied):
        """See `OnKeys`."""
        x, y, z = (float(abs(e) > TOLERANCE_M) * (1.0 if e > 0.0 else -1.0) for e in wanted - applied)
        self._set([-y, -x, 0.0, -z])

    def rest(self):
        """Let go of everything."""
        self._set([0.0] * 4)

    def _set(self, axes):
        self._page.evaluate("(axes) => { window.axes = axes; }", axes)


class OnPointer:
    """Drags on the pointer's pad, its depth on the wheel."""

    script = ""
    device = "pointer"

    def __init__(self, page):
        self._page = page
        self._place = None

    def steer(self, wanted, applied):
        """See `OnKeys`: along with what is wanted, and slowly nearer to it where the robot is not there."""
        if self._place is None:
            self._grip()
            self._wanted = applied
        x, y, z = (float(d) for d in wanted - self._wanted + CALM * (wanted - applied))
        self._wanted = wanted
        self._place = self._place[0] - y * self._half / REACH_M, self._place[1] - z * self._half / REACH_M
        self._page.mouse.move(*self._place)
        self._page.mouse.wheel(0.0, -100.0 * x / NOTCH_M)

    def rest(self):
        """Lift the pen."""
        if self._place is not None:
            self._page.mouse.up()
            self._place = None

    def _grip(self):
        self._page.click("[data-pad-for=pointer]")
        box = self._page.locator(".pointer-pad").bounding_box()
        self._half = self._page.evaluate("document.querySelector('.pointer-pad').clientHeight") / 2
        self._place = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        self._page.mouse.move(*self._place)
        self._page.mouse.down()


HANDS = (OnKeys, OnGamepad, OnPointer)
