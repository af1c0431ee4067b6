"""An error that tells of a limit is told from any other, by number or by a library's words."""

import errno

import pytest

from services.process.limits import limit_reached


@pytest.mark.parametrize(
    ("error", "what"),
    [
        (MemoryError(), "memory"),
        (OSError(errno.ENOMEM, "Cannot allocate memory"), "memory"),
        (ImportError("libblas.so: failed to map segment from shared object"), "memory"),
        (OSError(errno.EMFILE, "Too many open files", "a.json"), "open files"),
        (ImportError("cannot open shared object file: Too many open files"), "open files"),
        (BlockingIOError(errno.EAGAIN, "Resource temporarily unavailable"), "processes or threads"),
        (RuntimeError("can't start new thread"), "processes or threads"),
    ],
    ids=str,
)
def test_a_limit_is_named_with_what_to_do(error, what):
    reached = limit_reached(error)
    assert reached.what == what
    assert "ulimit" in str(reached)


@pytest.mark.parametrize(
    "error", [ValueError("too many open files"), RuntimeError("no"), OSError(errno.ENOSPC, "full")]
)
def test_any_other_error_is_none(error):
    assert limit_reached(error) is None
