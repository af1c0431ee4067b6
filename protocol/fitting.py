"""Texts and lists cut to what a reader lets pass, before they are sent.

What a process says may quote what somebody gave it: a name in a refusal, a reason of a stop, a list that grew in a
day. A reader drops a message with one text too long as malformed, so the sender shortens it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from operator import attrgetter
from typing import Any, TypeVar

import msgspec
from msgspec import inspect

S = TypeVar("S", bound=msgspec.Struct)

Fit = Callable[[Any], Any]
"""Gives the value back, or a shorter one."""

CUT = "…"


def fit(value: S) -> S:
    """The message, its texts and lists no longer than their types allow; the same object where all of them are."""
    fit_ = _of_struct(type(value))
    fitted: S = value if fit_ is None else fit_(value)
    return fitted


@cache
def _of_struct(type_: type[msgspec.Struct]) -> Fit | None:
    info = inspect.type_info(type_)
    assert isinstance(info, inspect.StructType)  # for the type checker: a struct has no other
    texts = {
        field.name: field.type.max_length
        for field in info.fields
        if isinstance(field.type, inspect.StrType) and field.type.max_length is not None
    }
    others = {
        field.name: fit_ for field in info.fields if field.name not in texts and (fit_ := _of(field.type)) is not None
    }
    if not texts and not others:
        return None
    texts_fit = _all_shorter(texts)
    fits_of_texts = {name: _of_text(longest) for name, longest in texts.items()}

    def fitted(value: Any) -> Any:
        changed = {} if texts_fit(value) else _changed(value, fits_of_texts)
        if others:
            changed |= _changed(value, others)
        return msgspec.structs.replace(value, **changed) if changed else value

    return fitted


def _all_shorter(texts: Mapping[str, int]) -> Callable[[Any], bool]:
    """Whether none of a struct's texts is longer than the shortest bound of them: what of most messages is so.

    It is asked before every message that is sent, all texts at once: one by one takes several times as long.
    """
    if not texts:
        return lambda value: True
    shortest, first = min(texts.values()), next(iter(texts))
    read = attrgetter(first, *texts)  # of one name alone it would give no tuple
    return lambda value: len(max(read(value), key=len)) <= shortest


def _changed(value: Any, fits: Mapping[str, Fit]) -> dict[str, Any]:
    """The fields of a struct that were too long, as they fit."""
    changed = {}
    for name, fit_ in fits.items():
        before = getattr(value, name)
        after = fit_(before)
        if after is not before:
            changed[name] = after
    return changed


def _of(info: inspect.Type) -> Fit | None:
    """What fits a value of this type; None where nothing can be too long."""
    match info:
        case inspect.StrType(max_length=int() as longest):
            return _of_text(longest)
        case inspect.StructType(cls=cls):
            return _of_struct(cls)
        case inspect.VarTupleType(item_type=item, max_length=longest):
            return _of_tuple(_of(item), longest)
        case inspect.TupleType(item_types=items) if any(_of(item) for item in items):
            fits = [_of(item) or _whole for item in items]
            return lambda values: _fitted(values, [fit_(one) for fit_, one in zip(fits, values, strict=True)])
        case inspect.UnionType(types=types):
            (chosen,) = [one for one in types if not isinstance(one, inspect.NoneType)]
            inner = _of(chosen)
            return None if inner is None else lambda value: value if value is None else inner(value)
        case _:
            return None


def _of_tuple(item: Fit | None, longest: int | None) -> Fit | None:
    if item is None and longest is None:
        return None

    def fitted(values: tuple[Any, ...]) -> tuple[Any, ...]:
        kept = values if longest is None or len(values) <= longest else values[:longest]
        return kept if item is None else _fitted(kept, [item(one) for one in kept])

    return fitted


def _fitted(values: tuple[Any, ...], fitted: list[Any]) -> tuple[Any, ...]:
    return values if all(a is b for a, b in zip(values, fitted, strict=True)) else tuple(fitted)


def _of_text(longest: int) -> Fit:
    return lambda text: text if len(text) <= longest else text[: longest - len(CUT)] + CUT


def _whole(value: Any) -> Any:
    return value
