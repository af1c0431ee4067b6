"""Stores something, step by step, and says after each step that it is stored: `storing.py WHAT`."""

import os
import sys

from tests.power.stores import STORES

SAID = b"stored\n"


if __name__ == "__main__":
    for _ in STORES[sys.argv[1]].steps():
        os.write(sys.stdout.fileno(), SAID)
