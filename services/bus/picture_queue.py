"""How late pictures come, and what is missing: who looks at them tells the cameras, which send what comes through.

A queue on the way fills little by little and may stand for long, so that a picture is compared with the fastest of a
whole minute. The clocks need not agree; where one jumps, that is learnt within the minute. What stands makes every
picture late: one that waited for a packet that was lost has others behind it that did not wait, so that of the newest
the least lateness counts (K. Nichols and V. Jacobson, Controlling Queue Delay, ACM Queue 2012).
"""

from __future__ import annotations

from collections import deque

from protocol.messages import CameraImage, PictureQueue
from protocol.topics import PICTURE_QUEUE
from services.bus.bus import Bus
from services.bus.picture_stream import PictureStream
from services.bus.subscription import Received
from services.process.schedule import Schedule

REMEMBERED_NS = 60_000_000_000
"""For so long the fastest picture is remembered: clocks drift apart by 30 ms at most meanwhile."""

SPAN_NS = 1_000_000_000
"""Of each of these the fastest one; and what came longer ago says nothing of the queue now."""

NEWEST = 2
"""Pictures of a camera that say how late they come: few enough to tell of what is sent now, not of what was before."""


class Lateness:
    """Of one process' pictures, as they come."""

    def __init__(self) -> None:
        self._fastest: deque[tuple[int, int]] = deque()

    def late_ns(self, newest: Received[CameraImage]) -> int:
        """By how much a picture came later than the fastest one [ns]."""
        came_ns = newest.received_ns
        transit_ns, span = came_ns - newest.message.stamp_ns, came_ns // SPAN_NS
        if self._fastest and self._fastest[-1][0] == span:
            _, fastest = self._fastest.pop()
            self._fastest.append((span, min(fastest, transit_ns)))
        else:
            self._fastest.append((span, transit_ns))
        while self._fastest[0][0] < span - REMEMBERED_NS // SPAN_NS:
            self._fastest.popleft()
        return transit_ns - min(fastest for _, fastest in self._fastest)


class QueueReport:
    """One process', of all pictures that it looks at.

    Args:
        bus: to report on.
        pictures: the cameras'.
    """

    def __init__(self, bus: Bus, *pictures: PictureStream) -> None:
        self._bus = bus
        self._pictures = pictures
        self._lateness: dict[int, Lateness] = {}
        self._schedule = Schedule()
        self._seen: dict[PictureStream, Received[CameraImage]] = {}
        self._late: dict[PictureStream, deque[tuple[int, int]]] = {one: deque(maxlen=NEWEST) for one in pictures}
        self._captured_ns: int | None = None
        self._stale = 0

    def step(self, now_ns: int, *, jpeg_only: bool = False, waits: bool = False) -> None:
        """Look at what has come, and tell where there is anything to tell.

        Args:
            now_ns: the time.
            jpeg_only: nothing else can be shown here.
            waits: what came is no use, and a key picture is needed; what was lost on the way is noticed here.
        """
        for pictures in self._pictures:
            shown, newest = pictures.latest(), pictures.newest
            if newest is None or newest is self._seen.get(pictures):
                continue
            self._seen[pictures] = newest
            late_ns = self._late_ns(newest)
            self._late[pictures].append((newest.received_ns, late_ns))
            if newest is not shown:  # what cannot be shown makes nothing that is seen any younger
                continue
            drawn_ns = newest.message.stamp_ns - newest.message.captured_ns if newest.message.captured_ns else 0
            captured_ns = newest.received_ns - late_ns - max(0, drawn_ns)
            self._captured_ns = max(self._captured_ns or captured_ns, captured_ns)
        if self._schedule.due(PICTURE_QUEUE, now_ns):
            self._tell(now_ns, jpeg_only=jpeg_only, waits=waits or any(pictures.waits for pictures in self._pictures))

    def age_s(self, now_ns: int) -> float | None:
        """Of what the youngest picture shows, as far as it can be known [s]; None before the first picture."""
        return (now_ns - self._captured_ns) / 1e9 if self._captured_ns is not None else None

    def _tell(self, now_ns: int, *, jpeg_only: bool, waits: bool) -> None:
        """How late the pictures of the camera come that come latest; one that was thrown away as stale was that late.

        Whoever begins to look says so before the first picture.
        """
        stale = sum(pictures.stale for pictures in self._pictures)
        late_ns = [late for pictures in self._pictures if (late := self._standing_ns(pictures, now_ns)) is not None]
        if stale > self._stale:
            late_ns = [limit for pictures in self._pictures if (limit := pictures.limit_ns) is not None]
        self._stale = stale
        if late_ns or waits or jpeg_only or not self._seen:
            late_s = max(late_ns, default=0.0) / 1e9
            self._bus.publish(PICTURE_QUEUE, PictureQueue(late=late_s, waits=waits, jpeg_only=jpeg_only))

    def _late_ns(self, newest: Received[CameraImage]) -> int:
        """Than the fastest of all cameras of that process: pictures that always stand behind another one's are late."""
        publishers = {seen.message.publisher for seen in self._seen.values()}
        self._lateness = {one: self._lateness.get(one) or Lateness() for one in publishers}
        return self._lateness[newest.message.publisher].late_ns(newest)

    def _standing_ns(self, pictures: PictureStream, now_ns: int) -> int | None:
        """How late one camera's newest pictures came at least [ns]; None where there was none for a while."""
        return min((late for came_ns, late in self._late[pictures] if now_ns - came_ns <= SPAN_NS), default=None)
