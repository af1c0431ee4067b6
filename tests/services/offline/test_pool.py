"""The same work on every item, here and in processes of its own."""

import os

import pytest

from services.offline.pool import each
from services.process.exceptions import CommandFailed


def halve(number, progress):
    progress(0.5)
    if number < 0:
        raise CommandFailed(f"{number} cannot be halved")
    return number / 2, os.getpid()


@pytest.mark.parametrize("jobs", [1, pytest.param(2, marks=pytest.mark.system)])
def test_every_item_has_its_result_and_the_progress_grows_to_one(jobs):
    shares = []
    results = dict(each(halve, [2, 4, 6], jobs, shares.append))
    assert {number: half for number, (half, _) in results.items()} == {0: 1.0, 1: 2.0, 2: 3.0}
    apart = {process for _, process in results.values()} - {os.getpid()}
    assert bool(apart) == (jobs > 1)
    assert shares == sorted(shares)
    assert shares[-1] == pytest.approx(1.0)


@pytest.mark.parametrize("jobs", [1, pytest.param(2, marks=pytest.mark.system)])
def test_an_error_comes_back_as_itself(jobs):
    with pytest.raises(CommandFailed, match="-3 cannot be halved"):
        list(each(halve, [2, -3, 6], jobs))
