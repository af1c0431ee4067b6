"""One line for people, whatever went into it."""

from __future__ import annotations

from datetime import datetime

LONGEST_WORD = 200
"""Characters; longer than any name and most paths."""

LONGEST_LINE = 1000

_CUT = " ... "


def one_line(text: str) -> str:
    """The text in one line; of what is too long to be read its begin and its end.

    Args:
        text: of any length, that may echo what somebody wrote.
    """
    return _shortened(" ".join(_shortened(word, LONGEST_WORD) for word in text.split()), LONGEST_LINE)


def readable(text: str) -> str:
    """What somebody's program has sent, in one line that is printed and does nothing else at a terminal."""
    return "".join(letter for letter in one_line(text) if letter.isprintable())


def when(at: str, *, seconds: bool = False) -> str:
    """A time (ISO 8601) by the clock of whoever reads it, to the minute or the second; as it came where it is none."""
    try:
        moment = datetime.fromisoformat(at).astimezone()
    except ValueError:
        return readable(at)
    return moment.strftime("%Y-%m-%d %H:%M:%S" if seconds else "%Y-%m-%d %H:%M")


def _shortened(text: str, most: int) -> str:
    if len(text) <= most:
        return text
    kept = most - len(_CUT)
    end = kept // 3
    return text[: kept - end] + _CUT + text[-end:]
