"""The guides do what they say: their commands in an empty folder, in order, as a reader types them."""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

pytestmark = [pytest.mark.system, pytest.mark.sim]
RUN = [pytest.mark.zenoh, pytest.mark.alone]

GUIDES = Path(__file__).resolve().parents[2] / "deploy" / "guides"
BLOCK = re.compile(r"^```(sh|toml)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PROMISED = "# -> "
CODE = re.compile(r"exit code (\d+)")
WITHIN_S = 300.0
FEWEST = 4
"""Of each guide's steps there are more."""


class Typed(NamedTuple):
    """Commands that are typed together, the lines that they promise, and the exit code."""

    script: str
    lines: tuple[str, ...]
    code: int


class File(NamedTuple):
    """A file that the reader writes."""

    name: str
    content: str


def written(name):
    """The text of a guide."""
    return (GUIDES / f"{name}.md").read_text(encoding="utf-8")


def steps(guide):
    """What a reader does, in order."""
    for kind, name, content in BLOCK.findall(guide):
        if kind == "toml":
            yield File(name, content)
        else:
            yield from _typed(content)


def _typed(block):
    script, promised = [], []
    for line in [*block.splitlines(), None]:
        if line is not None and line.startswith(PROMISED):
            promised.append(line.removeprefix(PROMISED))
            continue
        if script and (promised or line is None):
            codes = [int(found[1]) for one in promised if (found := CODE.fullmatch(one))]
            lines = tuple(one for one in promised if not CODE.fullmatch(one))
            yield Typed("\n".join(script), lines, codes[0] if codes else 0)
            script, promised = [], []
        if line is not None:
            script.append(line)


def missing(lines, said):
    """The first promised line that does not stand in what was said, after the one before it; None where all do."""
    at = 0
    for line in lines:
        pattern = r"[^\n]*".join(re.escape(part) for part in line.split("..."))
        found = re.compile(pattern).search(said, at)
        if found is None:
            return line
        at = found.end()
    return None


@pytest.fixture
def environment(tmp_path):
    """A reader's, who has set Retouch up: a home of their own, and what the setup has made."""
    made = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    own = {key: value for key, value in os.environ.items() if not key.startswith("XDG_")}
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    return own | {"HOME": str(tmp_path), "XDG_CACHE_HOME": made, "PATH": path, "COLUMNS": "200"}


def typed(script, folder, environment):
    """The exit code, and what was said."""
    said = folder.parent / "said.txt"
    with said.open("wb") as out:
        command = ["bash", "-e", "-c", script]
        null = subprocess.DEVNULL
        running = subprocess.Popen(
            command, cwd=folder, env=environment, stdin=null, stdout=out, stderr=out, start_new_session=True
        )
        try:
            code = running.wait(WITHIN_S)
        finally:
            if running.poll() is None:
                os.killpg(running.pid, signal.SIGTERM)  # `retouch` ends what it has started
                running.wait()
    return code, said.read_text(errors="replace")


def follow(guide, folder, environment):
    """Do all that a guide says, in an empty folder; every promise is kept."""
    folder.mkdir()
    to_do = list(steps(guide))
    assert len(to_do) > FEWEST, "the guide is not read as it is written"
    for step in to_do:
        if isinstance(step, File):
            (folder / step.name).write_text(step.content, encoding="utf-8")
            continue
        code, said = typed(step.script, folder, environment)
        told = f"{step.script}\n{said[-6000:]}"
        assert code == step.code, told
        assert missing(step.lines, said) is None, f"not said: {missing(step.lines, said)}\n{told}"


@pytest.mark.parametrize("name", ["your-own-robot", "your-own-task"])
def test_a_guide_is_right_as_far_as_nothing_is_run(name, tmp_path, environment):
    before, heading, _ = written(name).partition("\n## Run it\n")
    assert heading
    follow(before, tmp_path / "empty", environment)


@pytest.mark.parametrize(
    "name",
    [
        pytest.param("your-own-robot", marks=[*RUN, pytest.mark.long]),
        pytest.param("your-own-task", marks=[*RUN, pytest.mark.long]),
        pytest.param("your-first-skill", marks=[*RUN, pytest.mark.long]),
    ],
)
def test_a_guide_does_what_it_says(name, tmp_path, environment):
    follow(written(name), tmp_path / "empty", environment)


def test_what_is_promised_is_looked_for_in_its_order():
    assert missing(("one, ... three", "four"), "a one, two, three\nfour\n") is None
    assert missing(("four", "one"), "one\nfour\n") == "one"
