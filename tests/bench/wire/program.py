"""One end of a way that messages go: a router, one that sends, or one that notes when each came.

Usage: program.py router|sender|camera|receiver CARRIER SETTINGS. SETTINGS is JSON: `ports`, of which a carrier takes
what it needs, `certificates`, the folder of an authority or null, and `payload`, hexadecimal. It says "ready", answers
each line on its input with one, and ends when it is killed. Nothing of the project is needed but for its own carrier:
other things than Zenoh are installed elsewhere.
"""

import gc
import importlib
import json
import struct
import sys
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[3]))

CLOCK = getattr(time, "CLOCK_BOOTTIME", time.CLOCK_MONOTONIC)
STAMP = struct.Struct("<q")
PICTURE_BYTES, PICTURE_HZ, CAMERAS = 30_000, 15.0, 2


def now_ns():
    """The clock of the machine, the same one for all processes."""
    return time.clock_gettime_ns(CLOCK)


class Notes:
    """When each command was sent and came, and how many pictures did."""

    def __init__(self):
        self._samples = []
        self._pictures = 0

    def hear(self, payload):
        """A stamped command is here, as bytes."""
        came_ns = now_ns()
        self._samples.append((STAMP.unpack_from(payload)[0], came_ns))

    def note(self, sent_ns, came_ns):
        """The same, of which both are known."""
        self._samples.append((sent_ns, came_ns))

    def see(self, picture):
        """A picture is here."""
        self._pictures += bool(picture)

    def take(self):
        """All since the last call."""
        samples, self._samples = self._samples, []
        pictures, self._pictures = self._pictures, 0
        return {"samples": samples, "pictures": pictures}


def paced(send, rate_hz, seconds, warm_s):
    """Send on time, without ever making up for what was late.

    Returns:
        When the first message that counts was sent [ns], and how many count.
    """
    period_ns, due = round(1e9 / rate_hz), now_ns()
    counts_from, end = due + round(1e9 * warm_s), due + round(1e9 * (warm_s + seconds))
    first, counted = counts_from, 0
    while due < end:
        if (left := due - now_ns()) > 0:
            time.sleep(left / 1e9)
        if due >= counts_from:
            if not counted:
                first = now_ns()
            counted += 1
        send()
        due += period_ns
        if (behind := now_ns() - due) > period_ns:
            due += behind // period_ns * period_ns
    return first, counted


def commands(carrier, settings):
    """Sends commands when it is asked to."""
    rest = bytes.fromhex(settings["payload"])[STAMP.size :]
    with carrier.sending(settings, "command") as send:
        print("ready", flush=True)
        for line in sys.stdin:
            rate_hz, seconds, warm_s = map(float, line.split())
            print(json.dumps(paced(lambda: send(STAMP.pack(now_ns()) + rest), rate_hz, seconds, warm_s)), flush=True)


def pictures(carrier, settings):
    """Sends both cameras' pictures while it is asked to."""
    picture, on, sending = bytes(PICTURE_BYTES), threading.Event(), threading.Lock()
    with carrier.sending(settings, "picture") as send:

        def film():
            while True:
                on.wait()
                with sending:
                    for _ in range(CAMERAS if on.is_set() else 0):
                        send(picture)
                time.sleep(1.0 / PICTURE_HZ)

        threading.Thread(target=film, daemon=True).start()
        print("ready", flush=True)
        for line in sys.stdin:
            with sending:  # once it is off nothing more is sent
                on.set() if line.strip() == "on" else on.clear()
            print("{}", flush=True)


def notes(carrier, settings):
    """Notes what comes, and tells it when it is asked to."""
    kept = Notes()
    with carrier.receiving(settings, kept):
        print("ready", flush=True)
        for _ in sys.stdin:
            print(json.dumps(kept.take()), flush=True)


def routes(carrier, settings):
    """Passes on what comes."""
    with carrier.routing(settings):
        print("ready", flush=True)
        sys.stdin.read()


ENDS = {"router": routes, "sender": commands, "camera": pictures, "receiver": notes}


def main(end, carrier, settings):
    """See the module."""
    module = importlib.import_module(f"tests.bench.wire.carriers.{carrier}")
    gc.freeze()
    ENDS[end](module, json.loads(settings))


if __name__ == "__main__":
    main(*sys.argv[1:])
