"""What a person wrote, into frozen dataclasses; what does not fit is told with its place and what would be right."""

import difflib
import math
import types
from collections.abc import Collection, Iterable, Mapping
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

T = TypeVar("T")


class Unfit(ValueError):
    """What is written does not fit; the text says where, and what would be right."""


def nearest(name: str, known: Collection[str]) -> str:
    """Return the name that was meant, as a question; or all that there are, where none is near."""
    meant = difflib.get_close_matches(name, known, 1)
    return f"did you mean {meant[0]}?" if meant else f"one of {', '.join(known) or 'none'}"


def read(kind: type[T], written: object, where: str = "") -> T:
    """Return what is written as a dataclass.

    Args:
        kind: Of the dataclass; a field's key is its name, without the underscore after one that Python keeps.
        written: As parsed.
        where: It stands, for errors.

    Raises:
        Unfit: An unknown or missing key, or a value of another kind.
    """
    if not isinstance(written, Mapping):
        raise Unfit(f"{_at(where)}expected a section, got {_named(written)}")
    expected = {one.name.rstrip("_"): one for one in fields(kind)}  # type: ignore[arg-type]
    for key in written:
        if key not in expected:
            raise Unfit(f"{_at(where)}unknown key {key}; {nearest(key, expected)}")
    hints = get_type_hints(kind)
    given = {}
    for key, one in expected.items():
        if key in written:
            given[one.name] = _value(hints[one.name], written[key], f"{where}.{key}".lstrip("."))
        elif _needed(one):
            raise Unfit(f"{_at(where)}the key is missing: {key}")
    return kind(**given)


def _needed(one: "Field[Any]") -> bool:
    return one.default is MISSING and one.default_factory is MISSING


def _value(hint: Any, written: object, where: str) -> Any:
    origin, inner = get_origin(hint), get_args(hint)
    if origin in (types.UnionType, Union):
        return _one_of([one for one in inner if one is not type(None)], written, where)
    if origin is Literal:
        if written not in inner:
            raise Unfit(f"{where}: expected one of {', '.join(inner)}, got {written!r}")
        return written
    if origin is tuple:
        return tuple(_items(inner, written, where))
    if origin is dict:
        if not isinstance(written, Mapping):
            raise Unfit(f"{where}: expected a section, got {_named(written)}")
        return {key: _value(inner[1], value, f"{where}.{key}") for key, value in written.items()}
    if is_dataclass(hint):
        return read(hint, written, where)  # type: ignore[arg-type]
    return _scalar(hint, written, where)


def _one_of(kinds: list[Any], written: object, where: str) -> Any:
    """The first kind that what is written looks like."""
    for kind in kinds:
        if isinstance(written, Mapping) == (is_dataclass(kind) or get_origin(kind) is dict) and (
            isinstance(written, list) == (get_origin(kind) is tuple) and (kind is not str or isinstance(written, str))
        ):
            return _value(kind, written, where)
    return _value(kinds[0], written, where)


def _items(inner: tuple[Any, ...], written: object, where: str) -> Iterable[Any]:
    if not isinstance(written, list):
        raise Unfit(f"{where}: expected a list, got {_named(written)}")
    if inner[-1] is not Ellipsis and len(written) != len(inner):
        raise Unfit(f"{where}: expected {len(inner)} values, got {len(written)}")
    kinds = (inner[0],) * len(written) if inner[-1] is Ellipsis else inner
    for number, (kind, one) in enumerate(zip(kinds, written, strict=True), 1):
        name = one.get("name") if isinstance(one, Mapping) else None
        yield _value(kind, one, f"{where} {name}" if isinstance(name, str) else f"{where}, number {number}")


def _scalar(kind: Any, written: object, where: str) -> Any:
    if kind is float and isinstance(written, int | float) and not isinstance(written, bool):
        if not math.isfinite(written):
            raise Unfit(f"{where}: expected a finite number")
        return float(written)
    if isinstance(written, kind) and isinstance(written, bool) == (kind is bool):
        return written
    raise Unfit(f"{where}: expected {_WORDS[kind]}, got {_named(written)}")


_WORDS = {float: "a number", int: "a whole number", str: "a text", bool: "true or false"}


def _named(written: object) -> str:
    kinds: dict[type, str] = {**_WORDS, list: "a list", dict: "a section"}
    return kinds.get(type(written), type(written).__name__)


def _at(where: str) -> str:
    return f"{where}: " if where else ""
