"""The operator on the far machine, as this one sees it: see `far_operator`."""

import subprocess
import sys
import threading
from collections import deque
from pathlib import Path

from tests.system.harness import START_S, eventually


class Operator:
    """The far operator's process; a context manager.

    Args:
        link: to the far machine.
        router: its endpoint.
    """

    def __init__(self, link, router):
        program = Path(__file__).with_name("far_operator.py")
        self._process = subprocess.Popen(
            [*link.there, sys.executable, program, router], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

        self._said = deque()
        self._listening = threading.Thread(target=self._listen, daemon=True)
        self._listening.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.kill()
        self._process.wait()
        self._listening.join()
        self._process.stdin.close()
        self._process.stdout.close()

    def _listen(self):
        for line in self._process.stdout:
            self._said.append(line.strip())

    def says(self, word):
        """Wait until it says this next."""
        eventually(lambda: self._said, START_S, f"the far operator says {word}")
        said = self._said.popleft()
        assert said == word, said

    def press(self):
        """Let it press the stop until it is confirmed."""
        self._process.stdin.write("stop\n")
        self._process.stdin.flush()
