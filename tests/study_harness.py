"""A study's pages, served with a journal of their own and a stand-in for the robot; as a process, to be killed, too.

`python -m tests.study_harness FOLDER PORT` serves the study in the folder until it is killed.
"""

import contextlib
import http.server
import sys
import threading
from datetime import UTC, datetime, timedelta
from pathlib import Path

from services.process.clock import SystemClock
from services.study.events import Attempted
from services.study.instruments.library import of_protocol
from services.study.journal import Journal
from services.study.page.desk import Desk
from services.study.page.page import StudyPage
from services.study.page.trials import Live
from services.study.personal import Personal
from services.study.protocol.protocol import load
from services.study.session.conductor import Conductor

PROTOCOL = Path(__file__).parent / "study_protocol.toml"

ROBOTS_PAGE = b"""<!doctype html><html lang="en"><title>stand-in</title>
<body style="font: 2rem sans-serif; padding: 2rem; color: #e6edf3; background: #0e1116">
<p>This stands in for the robot's page.</p><input aria-label="keys" autofocus></body></html>"""


def now():
    """The time of day."""
    return datetime.now(UTC)


def enrolled(journal):
    """Enrol participant 1."""
    Conductor(load(PROTOCOL), journal, {}).enrol(1, "en")


class StandInTrials:
    """Stands in for the robot: it runs what it is told, and makes the attempts that a test asks for."""

    def __init__(self, url):
        self.url = url
        self.desk = None
        self.running = None
        self.ready = True
        self.fault = ""
        self.started = []

    def start(self, number, part, language):
        self.running = (number, part)
        self.started.append((number, part.name, language))

    def stop(self, why):
        self.running = None

    def live(self):
        if self.running is None:
            return None
        number, part = self.running
        known = self.desk.conductor.participant(number).attempts.get(part.name, [])
        active = sum(attempt.active for attempt in known)
        updates = sum(attempt.success for attempt in known)
        lasted = int(known[-1].ended) if known else 0
        counted = {"attempts": len(known), "updates": updates, "lasted": lasted}
        return Live(number, part.name, acting=True, active=active, ready=self.ready, fault=self.fault, **counted)

    def attempt(self, *, success):
        """An execution ends."""
        number, part = self.running
        count = len(self.desk.conductor.participant(number).attempts.get(part.name, []))
        with self.desk.lock:
            self.desk.conductor.attempted(
                Attempted(
                    participant=number,
                    part=part.name,
                    number=count + 1,
                    teaching=self.desk.conductor.protocol.method(part.method).teaching,
                    updates=count,
                    success=success,
                    reached=success,
                    kicked_over=False,
                    collision=not success,
                    active=12.5,
                    began=20.0 * count,
                    ended=20.0 * count + 15.0,
                )
            )

    def finish(self, *, passed=True):
        """The part is over."""
        with self.desk.lock:
            (number, part), self.running = self.running, None
            self.desk.conductor.end(number, part, passed=passed, seconds=25.0)
            self.desk.settle(number)


class Served:
    """A study that is served.

    Attributes:
        desk: of it.
        trials: the stand-in.
        page: its server.
    """

    def __init__(self, folder, port, url, key=""):
        self.later = timedelta()
        protocol = load(PROTOCOL)
        instruments = of_protocol(protocol, None)
        self.journal = Journal(folder, self.utc)
        self.trials = StandInTrials(url)
        conductor = Conductor(protocol, self.journal, instruments)
        self.desk = Desk(conductor, instruments, self.trials, self.utc, Personal(folder))
        self.trials.desk = self.desk
        self.page = StudyPage(self.desk, SystemClock(), port=port, key=key)

    def utc(self):
        """The time of day, as much later as a test wants."""
        return now() + self.later

    @property
    def events(self):
        """All that was written down."""
        return [entry.event for entry in self.journal.entries]


@contextlib.contextmanager
def robots_page():
    """Address of a page that stands in for the robot's."""

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.end_headers()
            self.wfile.write(ROBOTS_PAGE)

        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_port}/"
    finally:
        server.shutdown()
        server.server_close()


@contextlib.contextmanager
def served(folder, port, key=""):
    """A study of this folder, until the context ends."""
    with robots_page() as url:
        study = Served(folder, port, url, key)
        try:
            study.page.start()
            yield study
        finally:
            study.page.close()
            study.journal.close()


if __name__ == "__main__":
    with served(Path(sys.argv[1]), int(sys.argv[2])):
        print("ready", flush=True)  # noqa: T201 - to whoever started it
        threading.Event().wait()
