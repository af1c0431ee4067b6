"""What other processes say, in the language that is spoken here: the table has it by its English words.

They say why they refuse, why they hold and what is broken in sentences, for whoever reads a log or a terminal, too.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache, lru_cache
from string import Formatter

from services.station.words.table import ENGLISH, Speech, speech

_LONGEST = 300
"""A longer sentence is none of the table's; it bounds how long is looked."""


def heard(said: str) -> str:
    """A sentence of another process; as it came where the table has not got it.

    What stands in it in the place of a fact is looked for as well: one reason may hold another.
    """
    if speech.language == ENGLISH or len(said) > _LONGEST:
        return said
    return _translated(speech.language, said)


@lru_cache(maxsize=256)
def _translated(language: str, said: str) -> str:
    for name, pattern in _patterns().items():
        found = pattern.fullmatch(said)
        if found is not None:
            facts = {fact: _translated(language, value) for fact, value in found.groupdict().items()}
            return speech.say(f"heard.{name}", **facts)
    return said


@cache
def _patterns() -> Mapping[str, re.Pattern[str]]:
    """By the words' names, those first that say most by themselves."""
    words = Speech().section("heard")
    return {name: _pattern(words[name]) for name in sorted(words, key=lambda name: -_said_by_itself(words[name]))}


def _pattern(words: str) -> re.Pattern[str]:
    parts = Formatter().parse(words)
    return re.compile("".join(re.escape(said) + (f"(?P<{fact}>.+?)" if fact else "") for said, fact, _, _ in parts))


def _said_by_itself(words: str) -> int:
    return sum(len(said) for said, _, _, _ in Formatter().parse(words))
