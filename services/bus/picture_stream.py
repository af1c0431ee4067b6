"""One camera's pictures as they come, and which of them can be shown: one that needs another that was lost cannot."""

from __future__ import annotations

from typing import NamedTuple

from protocol.messages import CameraImage, Coding
from services.bus.subscription import Received, Subscription

MOST_BYTES = 4_000_000
"""That pictures since one key picture may take together; what comes beyond them waits for the next."""


class Group(NamedTuple):
    """A picture, and before it all that it needs.

    Attributes:
        number: of the key picture; another one has another number.
        coding: of the pictures.
        pictures: in order, the first of them a key picture.
    """

    number: int
    coding: Coding
    pictures: tuple[bytes, ...]

    def after(self, shown: Group | None) -> tuple[bytes, ...]:
        """What has to be decoded by one who has decoded `shown`: the rest where that is its beginning, else all."""
        begun = shown is not None and shown.number == self.number
        return self.pictures[len(shown.pictures) :] if shown is not None and begun else self.pictures


NOTHING = Group(0, Coding.JPEG, ())


class PictureStream:
    """Follows one camera; used by one thread.

    Args:
        subscription: to its pictures.

    Attributes:
        newest: picture that came, whether it can be shown or not.
    """

    def __init__(self, subscription: Subscription[CameraImage]) -> None:
        self.newest: Received[CameraImage] | None = None
        self._subscription = subscription
        self._shown: Received[CameraImage] | None = None
        self._group = NOTHING

    @property
    def limit_ns(self) -> int | None:
        """Age at which a picture is thrown away [ns]."""
        return self._subscription.topic.stale_after_ns

    @property
    def stale(self) -> int:
        """How many pictures came too late so far."""
        return self._subscription.drops.stale

    @property
    def waits(self) -> bool:
        """The newest picture cannot be shown; the next key picture can."""
        return self.newest is not self._shown

    @property
    def group(self) -> Group:
        """The newest picture that can be shown, with all that it needs, as `latest` found it."""
        return self._group

    def latest(self) -> Received[CameraImage] | None:
        """The newest picture that can be shown, however old it has become since."""
        for received in self._subscription.take():
            self.newest = received
            if self._add(received.message):
                self._shown = received
        return self._shown

    def fresh(self, now_ns: int) -> CameraImage | None:
        """The newest picture that can be shown, where it is younger than the topic's time to become stale."""
        shown = self.latest()
        if shown is None or (self.limit_ns is not None and now_ns - shown.received_ns > self.limit_ns):
            return None
        return shown.message

    def _add(self, image: CameraImage) -> bool:
        if image.coding is Coding.JPEG or image.after_key == 0:
            self._group = Group(self._group.number + 1, image.coding, (image.data,))
            return True
        if not self._follows(image):
            return False
        self._group = self._group._replace(pictures=(*self._group.pictures, image.data))
        return True

    def _follows(self, image: CameraImage) -> bool:
        """Whether a picture is the next one after the newest that can be shown."""
        if self._shown is None:
            return False
        before = self._shown.message
        return (
            (image.publisher, image.sequence) == (before.publisher, before.sequence + 1)
            and (image.coding, image.after_key) == (before.coding, before.after_key + 1)
            and sum(map(len, self._group.pictures)) + len(image.data) <= MOST_BYTES
        )
