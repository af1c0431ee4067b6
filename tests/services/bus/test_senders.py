"""The newest message of each sender, while it is heard."""

from protocol.messages import Attendance
from protocol.topics import ATTENDANCE
from services.bus.memory import MemoryNetwork
from services.bus.senders import Senders
from services.process.clock import ManualClock


def test_the_newest_of_each_sender_that_is_followed_counts_until_it_falls_silent():
    clock = ManualClock()
    network = MemoryNetwork(clock)
    anna, bert, carl = (network.bus(f"station-{name}") for name in ("anna", "bert", "carl"))
    senders = Senders(
        network.bus().subscribe(ATTENDANCE), lambda told: told.process if told.process != "station-carl" else None
    )

    def there():
        return {name: received.message.holder for name, received in senders.there(clock.now_ns()).items()}

    for bus in (anna, bert, carl):
        bus.publish(ATTENDANCE, Attendance(holder="first"))
    assert there() == {"station-anna": "first", "station-bert": "first"}
    clock.advance(ATTENDANCE.stale_after_ns / 1e9)
    anna.publish(ATTENDANCE, Attendance(holder="second"))
    assert there() == {"station-anna": "second", "station-bert": "first"}
    clock.advance(1e-3)
    assert there() == {"station-anna": "second"}
