"""The `retouch` command as a program: this very code, whatever else is called `services` where it is started."""

import os
import sys
from pathlib import Path
from typing import NoReturn


def start() -> NoReturn:
    """Run the command, in an interpreter that is isolated from other projects, and end with its exit code."""
    sys.path.insert(0, str(Path(__file__).parent.parent))
    from services.process.isolation import isolate_children, retouch_command  # noqa: PLC0415  # only found now

    if not sys.flags.isolated:
        command = retouch_command(sys.argv[1:])
        os.execv(command[0], command)
    isolate_children()
    from services.cli import main  # noqa: PLC0415
    from services.process import streams  # noqa: PLC0415
    from services.process.ending import leave  # noqa: PLC0415

    streams.prepare()
    try:
        code = main()
    except BrokenPipeError:  # whoever read has enough
        code = 0
    except SystemExit as left:
        code = left.code if isinstance(left.code, int) else 0
    finally:
        streams.leave()
    leave(code)


if __name__ == "__main__":
    start()
