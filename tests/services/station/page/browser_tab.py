"""A browser tab in a unit test: says what is held, on a clock that the test moves."""

import msgspec

from services.station.page.said import Held, Hello, Pressed

MS = 1_000_000
PERIOD_MS = 20


class BrowserTab:
    """A tab of a desk."""

    def __init__(self, desk, tab=1, now_ms=1_000, *, token=None, load=None, name="", role="", account=None):
        self.desk = desk
        self.account = account
        self.tab = tab
        self.now_ms = now_ms
        self.sequence = 0
        self.number = 0
        self.load = load or f"load-{tab:04}"
        self.token = token or f"seat-{tab:04}"
        self.says(role, name)

    def says(self, role, name):
        """Who is there."""
        self.send(Hello(self.token, self.load, name, role))

    def send(self, message):
        self.desk.receive(self.tab, msgspec.json.encode(message), self.now_ms * MS, self.account)

    def hold(self, *keys, focused=True, visible=True, controllers=(), later_ms=PERIOD_MS, stamp_ms=None, **told):
        self.now_ms += later_ms
        self.sequence += 1
        stamp = self.now_ms if stamp_ms is None else stamp_ms
        self.send(Held(self.sequence, float(stamp), keys, visible, focused, controllers, (0, 0, 0, 0), **told))

    def keep_on(self, seconds, *keys, **state):
        for _ in range(round(seconds * 1_000 / PERIOD_MS)):
            self.hold(*keys, **state)

    def press(self, action, *, argument="", number=None, age_ms=0):
        self.number += 1
        self.sequence += 1
        number = self.number if number is None else number
        self.send(Pressed(self.sequence, float(self.now_ms - age_ms), number, action, argument))

    def input(self, later_ms=0):
        return self.desk.take_input((self.now_ms + later_ms) * MS)

    def standing(self, later_ms=0):
        return self.desk.standing(self.tab, (self.now_ms + later_ms) * MS)

    def leave(self):
        self.desk.leave(self.tab, self.now_ms * MS)
