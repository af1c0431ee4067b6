"""The study's server is killed, and comes back: pages go on, and nothing that was handed in or typed is lost."""

import contextlib
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from study_person import agree, answer, send, set_

from services.study import journal
from services.study.events import Answered, Attempted, GoneOn
from tests import study_harness
from tests.ports import free_port

pytest.importorskip("uvicorn")
from playwright.sync_api import expect

pytestmark = [pytest.mark.browser, pytest.mark.system]

ROOT = Path(__file__).parents[2]


class Server:
    """A process that serves a study."""

    def __init__(self, folder):
        self.folder, self.port = folder, free_port()
        self.process = None

    def start(self):
        command = [sys.executable, "-m", "tests.study_harness", str(self.folder), str(self.port)]
        self.process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout.readline() == "ready\n"

    def kill(self):
        if self.process is not None:
            self.process.send_signal(signal.SIGKILL)
            self.process.wait()
            self.process.stdout.close()
            self.process = None

    def events(self, kind):
        return [entry.event for entry in journal.read(self.folder) if isinstance(entry.event, kind)]

    def url(self, page):
        return f"http://127.0.0.1:{self.port}/{page}"


@pytest.fixture
def server(tmp_path):
    one = Server(tmp_path / "raw")
    with contextlib.closing(journal.Journal(one.folder, study_harness.now)) as writes:
        study_harness.enrolled(writes)
    one.start()
    yield one
    one.kill()


def test_a_form_that_is_half_filled_in_survives(server, visit):
    tab = visit(server.url("participant/1"))
    agree(tab)
    answer(tab, but=("age",))
    server.kill()
    expect(tab.locator(".offline")).to_be_visible()
    send(tab)  # nothing happens but that it says what is missing
    tab.locator("[data-question=age] input").first.check()
    send(tab)
    expect(tab.locator(".form .problem")).to_contain_text("The connection is lost")
    server.start()
    expect(tab.locator(".offline")).to_be_hidden()
    assert len(set_(tab)) == 7
    send(tab)
    expect(tab.locator("h1")).to_have_text("Training")
    assert len(server.events(Answered)) == 1


def test_a_trial_goes_on_in_its_middle(server, visit):
    tab, console = visit(server.url("participant/1")), visit(server.url("console"))
    agree(tab)
    answer(tab)
    send(tab)
    tab.click("button.go")
    tab.wait_for_selector("iframe")
    server.kill()
    server.start()
    expect(tab.locator(".notice")).to_have_text("It was interrupted, and goes on where it was.")
    expect(console.locator(".person-state")).to_have_text("interrupted")
    tab.get_by_role("button", name="Go on").click()
    tab.wait_for_selector("iframe")
    expect(console.locator(".person-state")).to_have_text("runs")
    assert [event.by_hand for event in server.events(GoneOn)] == [False]
    assert server.events(Attempted) == []
