"""A cluster gives what this machine gives; where there is none, one line says so."""

import pytest

from services.offline.cluster import each_at
from services.offline.pool import each
from services.process.exceptions import CommandFailed
from tests.ports import free_port

dask = pytest.importorskip("dask")
distributed = pytest.importorskip("distributed")


@pytest.fixture(scope="module")
def scheduler():
    """Address of a real scheduler, with two processes that work for it."""
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        yield cluster.scheduler_address


def halved(number, progress):
    progress(0.5)
    return number / 2


def refused(number, _):
    raise CommandFailed(f"{number} is not wanted")


def test_a_cluster_gives_what_this_machine_gives_and_tells_each_item(scheduler):
    told = []
    done = dict(each_at(scheduler, halved, range(20), lambda number, share: told.append((number, share))))
    assert done == dict(each(halved, range(20), 1))
    assert sorted(told) == [(number, 1.0) for number in range(20)]


def test_what_the_work_says_of_an_item_arrives_as_it_is(scheduler):
    with pytest.raises(CommandFailed, match=r"^7 is not wanted$"):
        list(each_at(scheduler, refused, [7], lambda *_: None))


def test_where_no_scheduler_answers_one_line_says_so():
    address = f"tcp://127.0.0.1:{free_port()}"
    with dask.config.set({"distributed.comm.timeouts.connect": "300ms"}), pytest.raises(CommandFailed) as raised:
        list(each_at(address, halved, [1], lambda *_: None))
    assert address in str(raised.value)
    assert "\n" not in str(raised.value)
