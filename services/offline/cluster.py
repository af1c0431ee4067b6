"""Independent pieces of work on a cluster of Dask, which somebody runs, and whose machines have the same installed.

See `services.offline.pool` for the same on the processors of this machine.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

from joblib import Parallel, delayed, parallel_config

from services.offline.pool import Advance, Progress
from services.process.exceptions import CommandFailed

Item = TypeVar("Item")
Result = TypeVar("Result")


def each_at(
    scheduler: str, work: Callable[[Item, Progress], Result], items: Sequence[Item], advance: Advance
) -> Iterator[tuple[int, Result]]:
    """Do the same work on every item; what is ready comes first.

    Args:
        scheduler: address of the cluster's, such as "tcp://10.0.0.1:8786".
        work: a function of a module, which its machines have too; the item and the result cross by pickle.
        items: to work on.
        advance: is told when each item is done.

    Yields:
        The number of an item and its result.

    Raises:
        CommandFailed: Dask is not installed, nobody answers there, or its machines cannot do it.
    """
    try:
        with parallel_config(backend="dask", scheduler_host=scheduler):
            parallel = Parallel(n_jobs=-1, return_as="generator_unordered", batch_size=1)
            for number, result in parallel(delayed(_done)(work, item, number) for number, item in enumerate(items)):
                advance(number, 1.0)
                yield number, result
    except ImportError as error:
        raise CommandFailed(f"the cluster at {scheduler} lacks something that is installed here: {error}") from None
    except ValueError as error:
        raise CommandFailed(f"--cluster: {str(error).partition('. ')[0]}; install 'retouch[cluster]'") from None
    except OSError as error:
        raise CommandFailed(f"--cluster {scheduler}: nobody answers there: {error}") from None


def _done(work: Callable[[Item, Progress], Result], item: Item, number: int) -> tuple[int, Result]:
    return number, work(item, lambda _: None)
