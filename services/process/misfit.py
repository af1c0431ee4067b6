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


def told(error: msgspec.ValidationError, kind: type) -> str:
    """What does not fit, in one line.

    Args:
        error: as raised.
        kind: of the struct that was to be read.
    """
    said = str(error)
    place = _PLACE.search(said)
    keys = place[1].split(".") if place and place[1] else []
    what = _PATTERN.sub("", _PLACE.sub("", said))
    fits = _type_at(inspect.type_info(kind), keys)
    unknown = _UNKNOWN.match(what)
    if unknown:
        known = [field.encode_name for field in _fields(fits)]
        better = "only others of these kinds have it" if unknown[1] in known else right(unknown[1], known)
        return f"{_named([*keys, ''])}unknown key {unknown[1]}; {better}"
    for name, words in _WORDS.items():
        what = what.replace(name, words)
    choices = _choices(fits)
    return f"{_named(keys)}{what[0].lower()}{what[1:]}" + (f"; one of {', '.join(choices)}" if choices else "")


def _named(keys: list[str]) -> str:
    """Section and key, as they stand in a file; of a list of sections the one that it is, counted from 1."""
    if not keys:
        return ""
    section, key = ".".join(keys[:-1]), _COUNTED.sub(lambda m: f", number {int(m[1]) + 1}", keys[-1])
    if not section:
        return f"{key}: "
    counted = _COUNTED.search(section)
    if counted is None:
        return f"[{section}] {key}".strip() + ": "
    return f"[[{_COUNTED.sub('', section)}]] number {int(counted[1]) + 1}{f', {key}' if key else ''}: "


def _type_at(kind: Any, keys: list[str]) -> Any:
    """What is expected under some keys; None where nothing is known of them."""
    for key in keys:
        if isinstance(kind, inspect.UnionType) and any(key == getattr(one, "tag_field", None) for one in kind.types):
            return kind  # the key says which of them it is
        name = _COUNTED.sub("", key)
        kind = next((field.type for field in _fields(kind) if field.encode_name == name), None)
        if name != key:
            kind = getattr(kind, "item_type", None)
    return kind


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
