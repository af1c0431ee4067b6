"""The `retouch` command as a program: this very code, whatever else is called `services` where it is started."""

import os
import sys
from pathlib import Path


def start() -> int:
    """Run the command, in an interpreter that is isolated from other projects; the exit code."""
    sys.path.insert(0, str(Path(__file__).parent.parent))
    from services.process.isolation import retouch_command  # noqa: PLC0415  # only found now

    if not sys.flags.isolated:
        command = retouch_command(sys.argv[1:])
        os.execv(command[0], command)
    from services.cli import main  # noqa: PLC0415
    from services.process import streams  # noqa: PLC0415

    streams.prepare()
    try:
        return main()
    except BrokenPipeError:  # whoever read has enough
        return 0
    finally:
        streams.leave()


if __name__ == "__main__":
    raise SystemExit(start())
