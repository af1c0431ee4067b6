"""What the study's pages say: a file a language."""

from __future__ import annotations

from pathlib import Path

FOLDER = Path(__file__).parent
