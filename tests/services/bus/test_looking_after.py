"""A link that was lost is looked after: dialled at once where the way is another one, else after the transport."""

import pytest

from services.bus.reach import OPEN_LEAST_MS, Silence
from services.bus.zenoh import redialling
from services.bus.zenoh.transport import REDIAL_MS, SECURE_REDIAL_MS
from services.process.endpoint import parse


class End:
    """Of looking after a link; nobody waits for it, and all waits are noted."""

    def __init__(self):
        self.waited = []
        self._set = False

    def set(self):
        """No more."""
        self._set = True

    def is_set(self):
        """Whether."""
        return self._set

    def wait(self, seconds):
        """Note it."""
        self.waited.append(seconds)
        return self._set


class Link:
    """One that was lost, and is needed no more once a session was taken in its place.

    Args:
        takes: how many sessions are offered until one is taken.
    """

    endpoint = parse("tcp/127.0.0.1:7447")
    credentials = None
    pace_ms = OPEN_LEAST_MS

    def __init__(self, takes=1):
        self.end = End()
        self.offered = []
        self._looks = iter([False])
        self._takes = takes

    def is_linked(self):
        """As Zenoh says: lost at first, then there."""
        return next(self._looks, True)

    def take(self, opened):
        """Was opened."""
        self.offered.append(opened)
        if len(self.offered) == self._takes:
            self.end.set()
        return len(self.offered) == self._takes


@pytest.fixture
def looked_after(monkeypatch):
    """A function that looks after a link over such a way, where every dialling opens; what was offered to it."""

    def look(link, trips):
        turn = iter(trips)

        def probe(_):
            trip = next(turn, None)
            if trip is None:
                link.end.set()
                return Silence("no more is tried")
            return trip

        monkeypatch.setattr(redialling, "probe", probe)
        monkeypatch.setattr(redialling, "Dialling", At)
        redialling.Redialling(link, link.end).run()
        return link.offered

    return look


class At:
    """Dialling that has opened at once."""

    def __init__(self, endpoint, credentials):
        assert credentials is Link.credentials
        self.opened = endpoint.text

    def start(self):
        """Dial."""

    def is_alive(self):
        """Whether it goes on."""
        return False


def test_a_way_that_has_become_too_long_is_dialled_as_soon_as_it_is_there(looked_after):
    link = Link()
    assert looked_after(link, [Silence("no route"), Silence("no answer"), 0.3]) == [Link.endpoint.text]
    assert redialling.grace_s(Link.pace_ms, None) not in link.end.waited


def test_a_way_that_is_as_before_is_left_to_the_transport_first(looked_after):
    link = Link()
    assert looked_after(link, [0.0]) == [Link.endpoint.text]
    assert link.end.waited.count(redialling.grace_s(Link.pace_ms, None)) == 1


@pytest.mark.parametrize(("credentials", "between_ms"), [(None, REDIAL_MS), (object(), SECURE_REDIAL_MS)])
def test_a_deaf_link_is_opened_anew_after_two_attempts_of_the_transport(credentials, between_ms):
    """The first may have begun before the way was there; a link that the second found may be deaf."""
    assert redialling.grace_s(300, credentials) == pytest.approx(2 * (300 + between_ms) / 1e3)


def test_a_way_that_is_not_there_is_not_dialled(looked_after):
    assert looked_after(Link(), [Silence("no answer")] * 20) == []


def test_a_session_that_could_not_be_taken_is_followed_by_another_although_the_link_is_back(looked_after):
    assert len(looked_after(Link(takes=3), [0.0] * 3)) == 3
