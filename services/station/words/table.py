"""The one table of words. A language is a file beside this one; the process speaks one, as it has one locale.

A word is named by its section and its key, "light.green"; what stands in braces in it is filled in where it is said.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from services.web.words import read

HERE = Path(__file__).parent
ENGLISH = "en"


class Speech:
    """Says things in one language.

    Attributes:
        language: its tag, as `html lang` has it (BCP 47).
        words: all of them, by section and name.
    """

    def __init__(self) -> None:
        self.language = ENGLISH
        self.words = read(HERE / f"{ENGLISH}.toml")
        self._sections: dict[str, Mapping[str, str]] = {}

    def speak(self, language: str, folder: Path = HERE) -> None:
        """Say everything in this language from now on; what it has no word for stays English.

        Args:
            language: name of a file in the folder, without its ending.
            folder: of the tables.

        Raises:
            LookupError: there is no such table; names those that there are.
        """
        tables = _tables(folder)
        if language not in tables:
            raise LookupError(f"there are no words in {language!r}, only in {', '.join(sorted(tables))}")
        self.language = language
        self.words = {**read(HERE / f"{ENGLISH}.toml"), **read(tables[language])}
        self._sections.clear()

    def say(self, key: str, **facts: object) -> str:
        """The words of this name.

        Args:
            key: section and name.
            facts: by the names that stand in braces in it.
        """
        return self.words[key].format(**facts)

    def section(self, name: str) -> Mapping[str, str]:
        """All words of a section, as they stand in the table: the page's scripts fill in the facts themselves."""
        if name not in self._sections:
            start = f"{name}."
            words = {key.removeprefix(start): said for key, said in self.words.items() if key.startswith(start)}
            self._sections[name] = words
        return self._sections[name]


def languages() -> frozenset[str]:
    """All that there are tables of."""
    return frozenset(_tables(HERE))


def _tables(folder: Path) -> dict[str, Path]:
    return {file.stem: file for file in folder.glob("*.toml")}


speech = Speech()
say = speech.say
