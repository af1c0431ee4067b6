"""The power goes at any moment: what was said to be stored is there, and whatever is there can be read."""

import os
import random
import shutil
from pathlib import Path

import pytest

from tests.power.disk import Chance, Disk, everything, nothing
from tests.power.stores import STORES
from tests.power.storing import SAID
from tests.power.traced import traced

pytestmark = pytest.mark.system

PROGRAM = Path(__file__).with_name("storing.py")
ROOT = Path(__file__).parents[2]
HOMES = ("XDG_DATA_HOME", "XDG_STATE_HOME", "XDG_CONFIG_HOME")
WRITES = ("write", "pwrite64")
CHANCES = 8
"""Of what any of it may have come to the disk, at each moment."""


@pytest.fixture
def loader(monkeypatch, tmp_path):
    """A function that gives what a store finds in what is left of a disk."""
    folder = tmp_path / "left"
    for home in HOMES:
        monkeypatch.setenv(home, str(folder))
    monkeypatch.setattr(os, "fsync", lambda file: None)  # what is left is looked at once

    def load(store, left):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        for path, content in left.items():
            if content is None:
                (folder / path).mkdir()
            else:
                (folder / path).write_bytes(content)
        return store.found()

    return load


def moments(calls, root):
    """Before and after each call that brings something to the disk: how many steps were said to be stored, the disk.

    In between it is left as it may be at the end as well.
    """
    disk, said, changed = Disk(root), 0, True
    for call in calls:
        stored = call.name == "write" and call.arguments[:2] == ("1", SAID)
        if changed and (stored or call.name not in WRITES):
            yield said, disk
        said += stored
        changed = disk.follow(call) or stored
        if changed and (stored or call.name not in WRITES):
            yield said, disk


@pytest.mark.parametrize("what", STORES)
def test_what_is_said_to_be_stored_outlives_a_power_cut(what, tmp_path, loader):
    store, root = STORES[what], tmp_path / "home"
    root.mkdir()
    environment = {**os.environ, **dict.fromkeys(HOMES, str(root)), "PYTHONPATH": str(ROOT)}
    calls = traced(PROGRAM, [what], tmp_path, environment)
    whole = {}
    for said, disk in moments(calls, root):
        if said not in whole:
            whole[said] = loader(store, disk.left(everything, everything))
    steps = max(whole)
    assert len({str(found) for found in whole.values()}) == steps + 1, "every step changes something"
    whole[steps + 1] = whole[steps]
    rng, tried = random.Random(20261127), set()
    for number, (said, disk) in enumerate(moments(calls, root)):
        for names, contents in survivals(rng):
            left = disk.left(names, contents)
            case = said, frozenset(left.items())
            if case in tried:
                continue
            tried.add(case)
            for part, value in loader(store, left).items():
                before, after = whole[said][part], whole[said + 1][part]
                between = isinstance(value, list) and value == after[: len(value)] and len(value) >= len(before)
                assert between or value in (before, after), f"moment {number}, {said} steps stored: {part}"


def survivals(rng):
    """What is left: nothing that was not synchronised, all of it, names or contents alone, and any of it."""
    yield nothing, nothing
    yield everything, everything
    yield everything, nothing
    yield nothing, everything
    for _ in range(CHANCES):
        chance = Chance(rng)
        yield chance.names, chance.contents
