"""A hand on the keys of a page: as a person does, it lets go and presses again where the page did not hear it."""

import time

HEARD_WITHIN_S = 1.5


class Hand:
    """Holds keys down in a tab.

    Args:
        tab: that has the input.
        station: its page.
        within_s: it gives up after this time [s].
    """

    def __init__(self, tab, station, within_s):
        self._tab = tab
        self._station = station
        self._within_s = within_s
        self._down = ()

    def hold(self, *keys):
        """Hold these keys and no others, until the station counts them."""
        deadline = time.monotonic() + self._within_s
        while True:
            self.let_go()
            for key in keys:
                self._tab.page.keyboard.down(key)
            self._down = keys
            if self._becomes(set(keys), HEARD_WITHIN_S):
                return
            assert time.monotonic() < deadline, f"{keys} do not count"

    def let_go(self):
        """Hold nothing, until the station says that somebody is at the keys and holds nothing."""
        for key in self._down:
            self._tab.page.keyboard.up(key)
        self._down = ()
        assert self._becomes(set(), self._within_s), "the page has not the focus"

    def _becomes(self, keys, within_s):
        deadline = time.monotonic() + within_s
        while time.monotonic() < deadline:
            held = self._station.take_input()
            if held.focused and set(held.keys) == keys:
                return True
            time.sleep(0.005)
        return False
