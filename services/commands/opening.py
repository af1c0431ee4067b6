"""Opens a page in a browser of this machine, where there is one."""

from __future__ import annotations

import shutil
import sys
import threading
import webbrowser


def open_in_browser(url: str) -> None:
    """Open it; returns at once, and says nothing where it cannot."""
    if shutil.which("xdg-open") or sys.platform == "darwin":
        # On a thread of its own: some browsers return when they are closed.
        threading.Thread(target=webbrowser.open, args=(url,), daemon=True).start()
