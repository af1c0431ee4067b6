"""Questionnaires: those that come with Retouch, by their names, and a study's own."""

from __future__ import annotations

from pathlib import Path

SHIPPED = {path.stem: path for path in sorted(Path(__file__).parent.glob("*.toml"))}
