"""What a command's exit code tells."""

from enum import IntEnum


class Exit(IntEnum):
    """The cause of a command's end.

    DONE: it did what it was started for.
    CRASHED: a fault of the product's, or a run that did not reach its aim.
    BAD_INPUT: a file, flag or configuration that a person has to mend.
    ENVIRONMENT: the network or the machine: a folder, a disk, a port, a library.
    TRY_AGAIN: the same, said to a supervisor only, where waiting may mend it.
    INTERRUPTED: a person ended it before.
    """

    DONE = 0
    CRASHED = 1
    BAD_INPUT = 2
    ENVIRONMENT = 3
    TRY_AGAIN = 75
    INTERRUPTED = 130
