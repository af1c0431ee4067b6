"""What a model tells of its history: its entries, and what one of them changed."""

from __future__ import annotations

from typing import Annotated

import msgspec

from protocol.messages import Array, Count, Fraction, Method, Motion, Name, Part, Purpose, Real, Vector3

ENTRIES_AT_ONCE = 256


class Entry(msgspec.Struct, frozen=True):
    """A demonstration in the history.

    Attributes:
        id: by which it is called: the model version that it made.
        purpose: what it is for the model.
        method: how it was given.
        operator: who gave it; empty where nobody did.
        at: when: UTC by the model's clock, ISO 8601; empty where that is not known.
        alpha: how far it is believed, as in `AddDemonstration`.
        part: of the motion that it speaks of.
        object_position: that its motion is relative to, base frame [m].
        mean: how far its way is from the one that was predicted before it [m]; negative where none was.
        most: the same, where it is farthest [m].
        in_use: the model is made of it.
        turned_by: who took it back, or into use again; empty where nobody did.
        turned_at: when; see `at`.
    """

    id: Count
    purpose: Purpose
    method: Method
    operator: Name
    at: Name
    alpha: Fraction
    part: Part
    object_position: Vector3
    mean: Real
    most: Real
    in_use: bool
    turned_by: Name = ""
    turned_at: Name = ""


class ListHistory(msgspec.Struct, frozen=True):
    """Ask for the newest entries.

    Attributes:
        before: only those whose ids are lower; 0 for the newest of all.
    """

    before: Count = 0


class HistoryListed(msgspec.Struct, frozen=True, tag_field="reply", tag="history"):
    """Entries, the newest first.

    Attributes:
        version: of the model.
        entries: at most 256.
        older: how many there are beyond them.
    """

    version: Count
    entries: Annotated[tuple[Entry, ...], msgspec.Meta(max_length=ENTRIES_AT_ONCE)]
    older: Count = 0


class Compare(msgspec.Struct, frozen=True):
    """Ask what an entry changes: the model with it against the one without it, all others as they are now."""

    entry: Count


class Field(msgspec.Struct, frozen=True):
    """How far predictions are moved over the places of a target: along the two widest axes, in the middle of the rest.

    Attributes:
        axes: which two of a place's numbers vary: along the rows, along the columns.
        lower: the least of both [m].
        upper: the greatest [m].
        moved: greatest distance between the two predictions for each place, shape (rows, columns) [m].
        known: how much of the prediction is known there with the entry, the same shape.
        known_without: the same without it.
    """

    axes: tuple[Count, Count]
    lower: tuple[Real, Real]
    upper: tuple[Real, Real]
    moved: Array
    known: Array
    known_without: Array


class Effect(msgspec.Struct, frozen=True):
    """What an entry changes.

    Attributes:
        object_position: the place that it was given at, base frame [m].
        with_it: what is predicted there with it; None where that is nothing.
        without_it: the same without it.
        field: the same over all places; None where one of the two models predicts nothing.
    """

    object_position: Vector3
    with_it: Motion | None
    without_it: Motion | None
    field: Field | None


class Compared(msgspec.Struct, frozen=True, tag_field="reply", tag="compared"):
    """What an entry changes.

    Attributes:
        version: of the model that it was compared in.
        effect: None while it is being worked out: ask again.
    """

    version: Count
    effect: Effect | None
