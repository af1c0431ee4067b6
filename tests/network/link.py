"""A network that can be impaired: this machine, a far one in a namespace of its own, and a link between them."""

import itertools
import json
import os
import random
import secrets
import subprocess
import sys
import time
from pathlib import Path

_FORWARDER = Path(__file__).with_name("forwarder.py")

_numbers = itertools.cycle(random.SystemRandom().sample(range(2, 252), 250))
"""Several links of one machine have networks of their own."""

AHEAD_S = 1000
"""The far machine's clock, which is another one for it, shows so much more than this machine's [s]."""

_CLOCK = ("unshare", "--time", "--boottime", str(AHEAD_S), "--monotonic", str(AHEAD_S))

_OTHER_MACHINE = (
    "sh",
    "-c",
    "mount -t tmpfs tmpfs /dev/shm && cat /proc/sys/kernel/random/uuid >/dev/shm/boot"
    ' && mount --bind /dev/shm/boot /proc/sys/kernel/random/boot_id && exec "$@"',
    "sh",
)
"""It has started at another time; and Zenoh uses shared memory across the namespaces of one kernel, which no link can
cut."""


class Impossible(Exception):
    """This machine or this user cannot have namespaces and TUN devices."""


class Link:
    """The link; a context manager.

    Attributes:
        near: this machine's address on it.
        far: the far machine's address on it.
        there: what to put before a command so that it runs on the far machine.

    Raises:
        Impossible: on entering.
    """

    def __init__(self):
        number = next(_numbers)
        self.near, self.far = f"10.97.{number}.1", f"10.97.{number}.2"
        self._tag = secrets.token_hex(3)
        self._namespace = f"far{self._tag}"
        self.there = (*_CLOCK, "ip", "netns", "exec", self._namespace, *_OTHER_MACHINE)
        self._forwarder = None

    def __enter__(self):
        if os.geteuid() != 0 or not Path("/dev/net/tun").exists():
            raise Impossible("a cut link needs root and /dev/net/tun")
        near, far = f"near{self._tag}", f"far{self._tag}"
        try:
            _run("unshare", "--time", "--boottime", "1", "true")
            _ip("netns", "add", self._namespace)
            self._forwarder = subprocess.Popen(
                [sys.executable, _FORWARDER, near, far], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
            )
            if self._forwarder.stdout.readline() != "up\n":
                raise Impossible("no TUN device could be made")
            _ip("link", "set", far, "netns", self._namespace)
            inside = ("-n", self._namespace)
            _ip("addr", "add", f"{self.near}/24", "dev", near)
            _ip("link", "set", near, "up")
            _ip(*inside, "addr", "add", f"{self.far}/24", "dev", far)
            for device in ("lo", far):
                _ip(*inside, "link", "set", device, "up")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        if self._forwarder is not None:
            self._forwarder.stdin.close()
            self._forwarder.wait(5.0)
            self._forwarder.stdout.close()
        subprocess.run(["ip", "netns", "del", self._namespace], capture_output=True, check=False)

    def shape(self, **changes):
        """Change the link, see `forwarder.Shape`; when this returns it is so. The time of it, monotonic [s]."""
        self._forwarder.stdin.write(json.dumps(changes) + "\n")
        self._forwarder.stdin.flush()
        assert self._forwarder.stdout.readline() == "changed\n"
        return time.monotonic()

    def cut(self):
        """Nothing passes any more, and nobody is told; the time of it, monotonic [s]."""
        return self.shape(cut=True)

    def restore(self):
        """Everything passes again; the time of it, monotonic [s]."""
        return self.shape(cut=False)


def _ip(*arguments):
    _run("ip", *arguments)


def _run(*command):
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        raise Impossible(f"a cut link needs the command {command[0]}") from None
    if done.returncode:
        raise Impossible(f"{' '.join(command)}: {done.stderr.strip()}")
