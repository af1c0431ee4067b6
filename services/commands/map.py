"""`retouch map`: where a model succeeds, before and after its corrections."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import msgspec
import numpy as np
from rich.console import Console

from lfd.models.model import MovementModel
from lfd.store.database import DemonstrationStore
from lfd.store.stored import Purpose, StoredDemonstration
from services.commands.arguments import add_debug, place, whole, within
from services.commands.progress import bar
from services.commands.terminal import Terminal
from services.model.learning import learn_all
from services.model.skill import binding_of
from services.offline.first_demonstrations import first_demonstrations
from services.process.exceptions import CommandFailed
from services.process.exit_codes import Exit
from services.process.files import write_whole
from services.process.master_devices import Scripted
from services.process.runner import interruptible
from services.reproduction.exceptions import CannotKeep, NothingToMap
from services.reproduction.models import BY_NAME
from services.success_map import conditions as success_map
from services.success_map.conditions import Setting, SuccessMap, Target, in_turn
from services.success_map.figure import figure
from services.success_map.work import Learnt, Lesson, Tried, conditions, taught
from sim.tasks import SCENES, AnyScene
from sim.tasks import scene as find_scene

_SCENE = "dishwasher"

_ABOUT = """\
Executes a model's predictions under some hundred conditions (a target's place
and a start pose each), simulated on all cores, and draws which succeeded, before
the newest corrections and after them. A condition is unreachable, and does not
count, where no motion can start, or where every prediction fails and the scene's
own safe way does too: the map judges the model, not the scene. Shares come with
their 95 % interval (Wilson).
"""

_EXAMPLES = """\
examples:
  retouch map --teach                         the dishwasher, before and after one correction
  retouch map --teach --kind promp            the same with the thesis' own model
  retouch map --teach --corrections 4 --scene post
                                              before any and after four corrections, one after another
  retouch map --teach --people 20 --at 0.86,0.20,0.553
                                              twenty people, each with one correction at that end of the basket
  retouch map --database model.sqlite --before 3 --samples 400
                                              a model of yours, without its last 3 updates and with them
"""

_WIDEST_M = 0.5
"""Beyond it no scene has a start that the arm can take."""

_WIDEST_SCATTER_M = 0.2
_PLACES_A_CORRECTION = 4  # that are gone through until one fails, at most


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description, parser.epilog = _ABOUT, _EXAMPLES
    model = parser.add_argument_group("the model")
    model.add_argument("--kind", choices=("adaptive", "promp"), default="adaptive", help="promp: the thesis' own")
    model.add_argument(
        "--database", type=Path, metavar="FILE", help="that a model was taught into (default: first demonstrations)"
    )
    model.add_argument(
        "--before", type=whole(1), metavar="N", help="newest updates that the earlier stage lacks (default: 1)"
    )
    model.add_argument("--teach", action="store_true", help="let the scripted operator correct it first")
    teach = parser.add_argument_group("the corrections of --teach")
    teach.add_argument(
        "--corrections", type=whole(1), metavar="K", help="in sequence, at a place each that fails (default: 1)"
    )
    teach.add_argument(
        "--at",
        type=place,
        action="append",
        metavar="PLACE",
        help="a place to correct at, such as 0.86,0.20,0.553 [m], or y of the via-points; again for the next one"
        " (default: where the scene was trained, then as far from all others as there is)",
    )
    teach.add_argument(
        "--people", type=whole(1), metavar="N", help="operators, each with a seed and a model of their own (default: 1)"
    )
    teach.add_argument(
        "--scatter",
        type=within(0.0, _WIDEST_SCATTER_M, "metres"),
        metavar="M",
        help=f"between two ways that a person means alike [m] (default: {Scripted().scatter})",
    )
    where = parser.add_argument_group("the conditions")
    scenes = ", ".join(SCENES)
    where.add_argument("--scene", metavar="S", help=f"one of {scenes} (default: the database's, or dishwasher)")
    where.add_argument("--variant", metavar="V", help="of the scene (default: the one that was changed)")
    many = where.add_mutually_exclusive_group()
    many.add_argument("--grid", type=whole(1), metavar="N", default=16, help="about N times N, evenly (default: 16)")
    many.add_argument("--samples", type=whole(1), metavar="N", help="N at random instead")
    spread = within(0.0, _WIDEST_M, "metres")
    where.add_argument(
        "--spread", type=spread, metavar="M", default=0.05, help="of starts along each axis [m] (default: 0.05)"
    )
    where.add_argument("--seed", type=whole(0), metavar="N", default=0, help="of all that is random (default: 0)")
    parser.add_argument("--out", type=Path, metavar="FILE.png", default=Path("map.png"), help="default: ./map.png")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write what became of each condition")
    parser.add_argument("--jobs", type=whole(1), metavar="N", help="processes (default: one a core)")
    add_debug(parser)


def run(arguments: Namespace) -> int:
    """See `Action`."""
    with interruptible():
        try:
            draw_map(Request.from_arguments(arguments))
        except KeyboardInterrupt:
            Terminal(stderr=True, highlight=False).print("interrupted: no map is drawn")
            raise
    return Exit.DONE


@dataclass(frozen=True)
class Request:
    """What to map.

    Attributes:
        scene: by name; the database's, where there is one, by default.
        variant: of the scene; the changed one by default.
        kind: of the model, "adaptive" or "promp".
        database: that the model was taught into; the scene's first demonstrations by default.
        before: newest updates that the earlier stage lacks; one, where there is one, by default.
        teach: let the scripted operator correct the first demonstrations' model.
        corrections: in sequence; one by default, or one at each of the places.
        at: places to correct at, each shape (d,) [m].
        people: operators, each with a model of their own.
        scatter: of each, see `Scripted` [m].
        grid: about how many conditions, as a square's side.
        samples: how many random ones instead.
        spread: of the starts along each axis [m].
        seed: of all that is random.
        jobs: processes; one a core by default.
        out: the picture.
        json: what became of each condition.
    """

    scene: str | None = None
    variant: str | None = None
    kind: str = "adaptive"
    database: Path | None = None
    before: int | None = None
    teach: bool = False
    corrections: int | None = None
    at: list[Target] | None = None
    people: int | None = None
    scatter: float | None = None
    grid: int = 16
    samples: int | None = None
    spread: float = 0.05
    seed: int = 0
    jobs: int | None = None
    out: Path = Path("map.png")
    json: Path | None = None

    @classmethod
    def from_arguments(cls, arguments: Namespace) -> Self:
        """Of the command's flags."""
        return cls(**{name: getattr(arguments, name) for name in cls.__dataclass_fields__})


def draw_map(request: Request) -> SuccessMap:
    """Make the map, draw it, and say what came out in a line.

    Args:
        request: what to map.

    Raises:
        NothingToMap: the flags do not go together, or the database holds no model that can be mapped.
        CannotKeep: the picture cannot be written.
        StorageError: the database cannot be read.
        SimError: there is no such scene or variant.
    """
    _check(request)
    stored = _stored(request)
    scene = find_scene(request.scene or (stored[-1].binding.scene if stored else _SCENE))
    if any(len(one.demonstration.condition) != len(scene.region.lower) for one in stored):
        raise NothingToMap(f"{request.database} depends on more than the target's place: that cannot be mapped")
    variant = request.variant or scene.variants[-1]
    scene.check(variant)
    console = Terminal(stderr=True, highlight=False)
    jobs = request.jobs or os.cpu_count() or 1
    learnt = [Learnt(tuple(stored), ())] if stored else _first(request, scene, variant, jobs, console)
    stages = [_stages(request, one.stored) for one in learnt]
    settings = _settings(request, scene)
    task = Tried(scene.reference, variant, tuple(models for _, models in stages), settings)
    with bar(console, len(settings)) as advance:
        tried = conditions(task, jobs, advance)
    corrections = max(counts for counts, _ in stages)
    found = SuccessMap(scene.name, variant, request.kind, corrections, tuple(tried), learnt[0].corrected, len(learnt))
    _write(request.out, figure(scene, found, BY_NAME[request.kind]).image, "--out")
    if request.json:
        _write(request.json, msgspec.json.format(msgspec.json.encode(found)), "--json")
    console.print(found.summary(), soft_wrap=True)
    Terminal(highlight=False, soft_wrap=True).print(str(request.out.resolve()), markup=False)
    return found


def _check(request: Request) -> None:
    """All that can be said before anything is simulated."""
    if request.teach and request.database:
        raise NothingToMap("--teach starts from the first demonstrations: leave out --database, or --teach")
    if (request.corrections or request.at or request.people or request.scatter is not None) and not request.teach:
        raise NothingToMap("--corrections, --at, --people and --scatter say how to teach: give --teach too")
    if request.at and request.corrections and request.corrections > len(request.at):
        raise NothingToMap(f"--corrections {request.corrections} at {len(request.at)} places: give as many --at")
    if request.before and not request.database:
        raise NothingToMap("--before takes back updates of a database: give --database FILE")
    if request.out.suffix != ".png":
        raise NothingToMap(f"--out must name a .png file, not {str(request.out)!r}")
    for path, flag in ((request.out, "--out"), (request.json, "--json")):
        if path and not path.parent.is_dir():
            raise CommandFailed(f"{flag}: the folder {path.parent} does not exist")


def _stored(request: Request) -> list[StoredDemonstration]:
    """What the database holds; nothing where none was given."""
    if request.database is None:
        return []
    if not request.database.is_file():  # a store would make it
        raise NothingToMap(f"there is no file {request.database}: give the database of a model with --database")
    with DemonstrationStore(request.database) as store:
        stored = store.active()
        if stored:
            store.check(binding_of(find_scene(request.scene)) if request.scene else stored[-1].binding)
    if not stored:
        raise NothingToMap(f"{request.database} holds no demonstration: teach the model first")
    return stored


def _first(request: Request, scene: AnyScene, variant: str, jobs: int, console: Console) -> list[Learnt]:
    """The scene's first demonstrations, and each person's corrections where they are asked for."""
    if not request.teach:
        binding, shown = binding_of(scene), first_demonstrations(scene)
        initial = [StoredDemonstration(i, Purpose.INITIAL, binding, one) for i, one in enumerate(shown, 1)]
        return [Learnt(tuple(initial), ())]
    corrections = request.corrections or len(request.at or (0,))
    targets = request.at or in_turn(scene, _PLACES_A_CORRECTION * corrections)
    for target in targets:
        scene.check_place(np.array(target), scene.margin)
    demonstrations = first_demonstrations(scene)  # half a minute, where they are not kept
    scatter = Scripted().scatter if request.scatter is None else request.scatter
    where = scene.reference
    lessons = [
        Lesson(where, variant, request.kind, tuple(demonstrations), tuple(targets), corrections, seed, scatter)
        for seed in range(request.seed, request.seed + (request.people or 1))
    ]
    with console.status("the scripted operator corrects"):
        return taught(lessons, jobs)


def _stages(
    request: Request, stored: Sequence[StoredDemonstration]
) -> tuple[tuple[int, ...], tuple[MovementModel, ...]]:
    """How many corrections the model has learnt at each stage, and the model."""
    updates = sum(one.purpose is Purpose.UPDATE for one in stored)
    before = (updates if request.teach else min(1, updates)) if request.before is None else request.before
    if before > updates:
        raise NothingToMap(f"--before {before} takes back more than the {updates} updates of {request.database}")
    taken = (updates - before, updates) if request.teach else tuple(sorted({updates - before, updates}))
    newest_last = [one for one in stored if one.purpose is Purpose.UPDATE]
    initial = [one for one in stored if one.purpose is Purpose.INITIAL]
    models = [learn_all(request.kind, [*initial, *newest_last[:n]]) for n in taken]
    if any(model is None for model in models):
        raise NothingToMap("the model knows no motion before its updates: give a smaller --before")
    return taken, tuple(model for model in models if model is not None)


def _settings(request: Request, scene: AnyScene) -> tuple[Setting, ...]:
    if request.samples is None:
        return success_map.grid(scene, request.grid, request.spread)
    return success_map.sample(scene, request.samples, request.spread, np.random.default_rng(request.seed))


def _write(path: Path, content: bytes, flag: str) -> None:
    try:
        write_whole(path, content)
    except OSError as error:
        raise CannotKeep(path.parent, error.strerror or str(error), flag) from None
