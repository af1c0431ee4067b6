"""`python -m services` is the `retouch` command."""

from services.cli import main

if __name__ == "__main__":
    raise SystemExit(main())
