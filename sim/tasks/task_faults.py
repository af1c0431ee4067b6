"""What in a task file fits its kind and still cannot be, a line each."""

import re
from collections.abc import Iterator

import numpy as np

from sim.region import Region
from sim.tasks import written
from sim.tasks.reading import nearest
from sim.tasks.thing import FAMILIES

_NAME = re.compile(r"[a-z0-9][a-z0-9_-]{0,30}")


def found(said: written.WrittenTask) -> Iterator[str]:
    """Say what cannot be, a line each."""
    if not _NAME.fullmatch(said.name):
        yield f"name: {said.name!r} is no name: small letters, digits, - and _"
    if len(set(said.variants)) != len(said.variants):
        yield f"variants: both are called {said.variants[0]}"
    yield from _of_objects(said)
    yield from _of_variants(said)
    solids = [one.name for one in said.standing]
    for name in sorted({name for name in solids if solids.count(name) > 1}):
        if any(not one.variants for one in said.standing if one.name == name):
            yield f"boxes {name}: two have this name"
    success = said.success
    for name in success.may_touch:
        if name not in solids:
            yield f"success: may_touch: there is no box or mesh {name}; {nearest(name, solids)}"
    boxes = [one.name for one in said.boxes]
    if success.placed_on and success.placed_on not in boxes:
        yield f"success: placed_on: there is no box {success.placed_on}; {nearest(success.placed_on, boxes)}"
    sizes = {one.name: one.size for one in said.boxes} | {one.name: one.size for one in said.objects}
    for name, size in sizes.items():
        if min(size) <= 0.0:
            yield f"{name}: size: each edge has to be above 0"
    if min(*success.reached, *success.kicked_over) <= 0.0:
        yield "success: reached and kicked_over have to be above 0"


def _of_objects(said: written.WrittenTask) -> Iterator[str]:
    names = [one.name for one in said.objects]
    if not names:
        yield "objects: there is none; a task needs one that its motions lead to"
        return
    if len(set(names)) != len(names):
        yield f"objects: two are called {max(names, key=names.count)}"
    if said.target and said.target not in names:
        yield f"target: there is no object {said.target}; {nearest(said.target, names)}"
    yield from _of_tags(said)
    aim = target(said)
    if aim.tag is None:
        yield f"objects {aim.name}: motions are relative to it, and it has no tag to be seen by: give it one"
    region = Region(aim.region.lower, aim.region.upper)
    if not np.all(np.array(region.lower) <= region.upper):
        yield f"objects {aim.name}: region: lower is above upper"
    for number, place in enumerate(said.training_places, 1):
        if not region.contains(np.array(place), said.margin + 1e-9):
            yield f"training_places, number {number}: {list(place)} is outside the region of {aim.name}"
    if not said.training_places:
        yield "training_places: there is none; two or more that span the region are best"


def _of_tags(said: written.WrittenTask) -> Iterator[str]:
    owners: dict[tuple[str, int], str] = {}
    for one in said.objects:
        if one.tag is None:
            continue
        dictionary, number = one.tag.dictionary, one.tag.id
        if dictionary not in FAMILIES:
            yield f"objects {one.name}: unknown tag dictionary {dictionary}; {nearest(dictionary, FAMILIES)}"
        elif not 0 <= number < FAMILIES[dictionary][1]:
            yield f"objects {one.name}: unknown tag {number}: {dictionary} has 0 to {FAMILIES[dictionary][1] - 1}"
        other = owners.setdefault((dictionary, number), one.name)
        if other != one.name:
            yield f"objects {other} and {one.name} have the same tag, {number} of {dictionary}: give each its own"


def _of_variants(said: written.WrittenTask) -> Iterator[str]:
    for one in said.standing:
        for variant in one.variants:
            if variant not in said.variants:
                yield f"{one.name}: there is no variant {variant}; {nearest(variant, said.variants)}"
        if one.frame and one.frame not in said.frames:
            yield f"{one.name}: there is no frame {one.frame}; {nearest(one.frame, said.frames)}"
    for name, where in said.frames.items():
        for variant in said.variants:
            if variant not in where:
                yield f"frames.{name}: where is it in variant {variant}?"
    for variant in said.variants:
        if not any(not one.variants or variant in one.variants for one in said.standing):
            yield f"variant {variant} has no boxes: an object stands on something"
        if said.corridors and variant not in said.corridors:
            yield f"corridors: there is none for variant {variant}; draw both, or none"
    for variant in said.corridors:
        if variant not in said.variants:
            yield f"corridors: there is no variant {variant}; {nearest(variant, said.variants)}"


def target(said: written.WrittenTask) -> written.WrittenObject:
    """Return the object that motions are relative to."""
    return next((one for one in said.objects if one.name == said.target), said.objects[0])
