"""What a program asks the kernel to do with its files, call by call, as strace tells it."""

import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

CALLS = (
    *("openat", "open", "creat", "close", "dup", "dup2", "dup3", "lseek"),
    *("write", "pwrite64", "writev", "pwritev", "ftruncate", "truncate", "fallocate"),
    *(
        "rename",
        "renameat",
        "renameat2",
        "link",
        "linkat",
        "symlink",
        "unlink",
        "unlinkat",
        "mkdir",
        "mkdirat",
        "rmdir",
    ),
    *("fsync", "fdatasync", "sync_file_range", "msync"),
)
ENDS_S = 120.0

_WHOLE = re.compile(r"(?P<thread>\d+) +(?P<name>\w+)\((?P<rest>.*)\) += (?P<result>-?\d+)")
_BEGUN = re.compile(r"(?P<thread>\d+) +(?P<name>\w+)\((?P<rest>.*) <unfinished \.\.\.>")
_ENDED = re.compile(r"(?P<thread>\d+) +<\.\.\. (?P<name>\w+) resumed>(?P<rest>.*)\) += (?P<result>-?\d+)")
_ARGUMENT = re.compile(r'"(?P<text>(?:\\x[0-9a-f]{2})*)"|(?P<other>[^,"]+)')


class Call(NamedTuple):
    """That succeeded.

    Attributes:
        name: of the call.
        arguments: texts as bytes, everything else as strace writes it.
        result: as returned.
    """

    name: str
    arguments: tuple[bytes | str, ...]
    result: int


def traced(program: Path, arguments, folder: Path, environment):
    """Run a program to its end; its calls in the order in which they ended."""
    told = folder / "calls"
    command = ["strace", "-f", "-qq", "-xx", "-s", "16777216", "-e", f"trace={','.join(CALLS)}", "-e", "signal=none"]
    command += ["-o", str(told), sys.executable, str(program), *arguments]
    try:
        ended = subprocess.run(command, env=environment, capture_output=True, timeout=ENDS_S, check=False)
    except FileNotFoundError:
        pytest.skip("strace is not installed")
    if ended.returncode and b"ptrace" in ended.stderr.lower():
        pytest.skip("strace may not look at programs here")
    assert ended.returncode == 0, ended.stderr.decode()[-4000:]
    return list(_calls(told.read_text().splitlines()))


def _calls(lines):
    begun = {}
    for line in lines:
        if match := _BEGUN.fullmatch(line):
            begun[match["thread"]] = match["rest"]
            continue
        before = ""
        match = _WHOLE.match(line)
        if match is None:
            match = _ENDED.match(line)
            if match is None:
                continue
            before = begun.pop(match["thread"])
        result = int(match["result"])
        if result >= 0:
            yield Call(match["name"], _arguments(before + match["rest"]), result)


def _arguments(text):
    found = (match for match in _ARGUMENT.finditer(text) if match[0].strip())
    return tuple(
        bytes.fromhex(match["text"].replace("\\x", "")) if match["other"] is None else match["other"].strip()
        for match in found
    )
