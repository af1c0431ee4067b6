"""A real Firefox, driven by the protocol that it speaks itself: WebDriver BiDi, https://w3c.github.io/webdriver-bidi/.

Playwright asks this Firefox for more than it has, and its own Firefox is no package of any distribution.
"""

import contextlib
import itertools
import json
import socket
import subprocess
import time

from websockets.sync.client import connect

from tests.ports import free_port

START_S = 60.0
ANSWER_S = 120.0
POLL_S = 0.05
PREFERENCES = """
user_pref("app.update.enabled", false);
user_pref("browser.shell.checkDefaultBrowser", false);
user_pref("browser.startup.homepage_override.mstone", "ignore");
user_pref("datareporting.policy.dataSubmissionEnabled", false);
user_pref("toolkit.telemetry.reportingpolicy.firstRun", false);
user_pref("webgl.force-enabled", true);
user_pref("webgl.forbid-software", false);
"""
KEYS = {"Escape": "\ue00c", "Space": " "}
"""What the protocol calls keys that print nothing."""


@contextlib.contextmanager
def running(executable, profile):
    """A headless Firefox with an empty folder for its profile."""
    (profile / "user.js").write_text(PREFERENCES)
    port = free_port()
    command = [executable, "--headless", "--no-remote", "--profile", profile, f"--remote-debugging-port={port}"]
    silent = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with subprocess.Popen(command, **silent) as process:
        try:
            await_listener(port)
            with connect(f"ws://127.0.0.1:{port}/session", max_size=None, open_timeout=ANSWER_S) as link:
                yield Firefox(link)
        finally:
            process.terminate()


def await_listener(port):
    """Wait until somebody listens."""
    deadline = time.monotonic() + START_S
    while True:
        try:
            socket.create_connection(("127.0.0.1", port), timeout=1.0).close()
        except OSError:
            assert time.monotonic() < deadline, "Firefox does not start"
            time.sleep(POLL_S)
        else:
            return


class Firefox:
    """A Firefox, asked over its link."""

    def __init__(self, link):
        self._link = link
        self._numbers = itertools.count(1)
        self._log = []
        self.ask("session.new", capabilities={})
        self.ask("session.subscribe", events=["log.entryAdded"])

    def open(self, url, script):
        """Another tab with a page in it, in which a script is run before any other."""
        context = self.ask("browsingContext.create", type="tab")["context"]
        self.ask(
            "script.addPreloadScript",
            functionDeclaration=f"() => {{ if (location.host) {{ {script} }} }}",
            contexts=[context],
        )
        tab = Tab(self, context)
        self.ask("browsingContext.navigate", context=context, url=url, wait="complete")
        return tab

    def ask(self, method, **parameters):
        """The answer to a command."""
        number = next(self._numbers)
        self._link.send(json.dumps({"id": number, "method": method, "params": parameters}))
        deadline = time.monotonic() + ANSWER_S
        while True:
            message = json.loads(self._link.recv(deadline - time.monotonic()))
            if message["type"] == "event":
                self._log.append(message["params"])
            elif message["id"] == number:
                assert message["type"] == "success", message
                return message["result"]

    def faults(self, context):
        """What the page of a tab complained about."""
        return [
            entry["text"]
            for entry in self._log
            if entry["level"] == "error" and entry["source"].get("context") == context
        ]


class Tab:
    """A tab.

    Args:
        firefox: that it is in.
        context: the protocol's name of it.
    """

    def __init__(self, firefox, context):
        self._firefox = firefox
        self._context = context

    @property
    def faults(self):
        """What its page complained about."""
        return self._firefox.faults(self._context)

    def evaluate(self, expression):
        """The value of an expression of the page's."""
        answer = self._firefox.ask(
            "script.evaluate",
            expression=f"JSON.stringify({expression})",
            target={"context": self._context},
            awaitPromise=False,
        )
        assert answer["type"] == "success", answer
        return json.loads(answer["result"].get("value", "null"))

    def wait(self, selector, says="", within_s=30.0):
        """Wait until an element is seen, and says something."""
        found = f"[...document.querySelectorAll({json.dumps(selector)})].filter((e) => e.checkVisibility())"
        deadline = time.monotonic() + within_s
        while not any(says in words for words in self.evaluate(f"{found}.map((e) => e.textContent)")):
            assert time.monotonic() < deadline, f"{selector} {says} is not seen"
            time.sleep(POLL_S)

    def key(self, name, *, down):
        """Press a key down, or let it go."""
        kind, value = "keyDown" if down else "keyUp", KEYS.get(name, name)
        self._perform({"type": "key", "id": "keys", "actions": [{"type": kind, "value": value}]})

    def pointer(self, *actions):
        """Move the mouse to a selector's middle or by pixels, press it "down", let it go "up"."""
        self._perform({"type": "pointer", "id": "mouse", "actions": [self._pointed(action) for action in actions]})

    def bring_forward(self):
        """Let this tab be the one that is seen."""
        self._firefox.ask("browsingContext.activate", context=self._context)

    def close(self):
        """Close it."""
        self._firefox.ask("browsingContext.close", context=self._context)

    def _perform(self, source):
        self._firefox.ask("input.performActions", context=self._context, actions=[source])

    def _pointed(self, action):
        match action:
            case "down" | "up":
                return {"type": f"pointer{action.title()}", "button": 0}
            case (x, y):
                return {"type": "pointerMove", "x": x, "y": y, "origin": "pointer"}
            case selector:
                box = self.evaluate(f"document.querySelector({json.dumps(selector)}).getBoundingClientRect()")
                x, y = (round(box[start] + box[size] / 2) for start, size in (("x", "width"), ("y", "height")))
                return {"type": "pointerMove", "x": x, "y": y}
