"""What in a configuration does not fit, as who wrote the file would say it: section, key, and what would be right."""

from __future__ import annotations

import re
from typing import Any

import msgspec
from msgspec import inspect

from services.process.suggestion import right

_UNKNOWN = re.compile(r"Object contains unknown field `(.+)`")
_PLACE = re.compile(r" - at `\$\.?(.*)`$")
_COUNTED = re.compile(r"\[(\d+)\]")
_MISSING = re.compile(r"Object missing required field `(.+)`")
_PATTERN = re.compile(r" matching regex '.*'$")
_NAMED = re.compile(r"\^\(([\w|]+)\)\$")  # a pattern that is a list of texts

_WORDS = {
    "`str`": "a text",
    "`int`": "a whole number",
    "`int | null`": "a whole number",
    "`float`": "a number",
    "`bool`": "true or false",
    "`object`": "a section",
    "`array`": "a list",
    "`null`": "nothing",
    "Invalid enum value": "invalid value",
    "Object missing required field": "the key is missing:",
}


def told(error: msgspec.ValidationError, kind: type, written: Any) -> str:
    """What does not fit, in one line.

    Args:
        error: as raised.
        kind: of the struct that was to be read.
        written: what was read instead, as dictionaries and lists.
    """
    said = str(error)
    place = _PLACE.search(said)
    keys = place[1].split(".") if place and place[1] else []
    what = _PATTERN.sub("", _PLACE.sub("", said))
    fits, there = _at(inspect.type_info(kind), written, keys)
    unknown, missing = _UNKNOWN.match(what), _MISSING.match(what)
    if unknown:
        elsewhere = unknown[1] in _names(fits)
        better = "only others of these kinds have it" if elsewhere else right(unknown[1], _names(_meant(fits, there)))
        return f"{_named([*keys, ''])}unknown key {unknown[1]}; {better}"
    for name, words in _WORDS.items():
        what = what.replace(name, words)
    choices = [] if missing and missing[1] not in _tags(fits) else _choices(fits)
    if missing and keys and _COUNTED.search(keys[-1]):
        keys = [*keys, ""]  # of a section among several, not the section itself
    return f"{_named(keys)}{what[0].lower()}{what[1:]}" + (f"; one of {', '.join(choices)}" if choices else "")


def _named(keys: list[str]) -> str:
    """Section and key, as they stand in a file; of a list of sections the one that it is, counted from 1."""
    if not any(keys):
        return ""
    section, key = ".".join(keys[:-1]), _COUNTED.sub(lambda m: f", number {int(m[1]) + 1}", keys[-1])
    if not section:
        return f"{key}: "
    counted = _COUNTED.search(section)
    if counted is None:
        return f"[{section}] {key}".strip() + ": "
    return f"[[{_COUNTED.sub('', section)}]] number {int(counted[1]) + 1}{f', {key}' if key else ''}: "


def _at(kind: Any, written: Any, keys: list[str]) -> tuple[Any, Any]:
    """What is expected under some keys, and what is written there; None where nothing is known of them."""
    for key in keys:
        if key in _tags(kind):
            return kind, None  # the key says which of them it is
        name, places = _COUNTED.sub("", key), [int(place) for place in _COUNTED.findall(key)]
        kind = next((field.type for field in _fields(_meant(kind, written)) if field.encode_name == name), None)
        written = written.get(name) if isinstance(written, dict) else None
        for place in places:
            kind = getattr(kind, "item_type", None)
            written = written[place] if isinstance(written, list) else None
    return kind, written


def _meant(kind: Any, written: Any) -> Any:
    """Of several kinds of sections the one that was written, where that says which."""
    if isinstance(kind, inspect.UnionType) and isinstance(written, dict):
        tagged = [one for one in kind.types if isinstance(one, inspect.StructType) and one.tag_field]
        return next((one for one in tagged if written.get(one.tag_field) == one.tag), kind)
    return kind


def _tags(kind: Any) -> set[str]:
    """Keys that say which of several kinds of sections it is."""
    types = kind.types if isinstance(kind, inspect.UnionType) else ()
    return {one.tag_field for one in types if isinstance(one, inspect.StructType) and one.tag_field}


def _names(kind: Any) -> list[str]:
    """Keys of a section, or of any that can stand there, each once."""
    return list(dict.fromkeys(field.encode_name for field in _fields(kind)))


def _fields(kind: Any) -> list[inspect.Field]:
    """Of a section, or of any that can stand there."""
    if isinstance(kind, inspect.UnionType):
        return [field for one in kind.types for field in _fields(one)]
    return list(kind.fields) if isinstance(kind, inspect.StructType) else []


def _choices(kind: Any) -> list[str]:
    if isinstance(kind, inspect.StrType) and (named := _NAMED.fullmatch(kind.pattern or "")):
        return named[1].split("|")
    if isinstance(kind, inspect.LiteralType):
        return [str(value) for value in kind.values]
    if isinstance(kind, inspect.EnumType):
        return [str(member.value) for member in kind.cls]
    if isinstance(kind, inspect.UnionType):
        return [str(one.tag) for one in kind.types if isinstance(one, inspect.StructType) and one.tag]
    return []
