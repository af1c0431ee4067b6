"""`retouch map`: where a model succeeds, before and after its corrections."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import msgspec
import numpy as np
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, Task, TextColumn, TimeRemainingColumn
from rich.text import Text

from lfd.models.model import MovementModel
from lfd.store.database import DemonstrationStore, Purpose, StoredDemonstration
from services.commands.arguments import add_debug, whole, within
from services.commands.terminal import Terminal
from services.model.learning import learn_all
from services.model.skill import binding_of
from services.offline.first_demonstrations import first_demonstrations
from services.process.exceptions import CommandFailed
from services.process.files import write_whole
from services.reproduction.exceptions import CannotKeep, NothingToMap
from services.reproduction.models import BY_NAME
from services.success_map import conditions as success_map
from services.success_map.conditions import Setting, SuccessMap
from services.success_map.figure import figure
from services.success_map.work import Tried, conditions, corrected_once
from sim.tasks import REACHING, AnyScene
from sim.tasks import scene as find_scene
from sim.tasks.scene import ReachingScene

_POSITION = 3  # dimension of the condition that a map is made of
_SCENE = "dishwasher"

_ABOUT = """\
Executes a model's predictions under some hundred conditions (an object's position
and a start pose each), simulated on all cores, and draws which succeeded, before
the newest corrections and after them. A condition is unreachable, and does not
count, where no motion can start, or where every prediction fails and the scene's
own safe way does too: the map judges the model, not the scene.
"""

_EXAMPLES = """\
examples:
  retouch map --teach                         the dishwasher, before and after one correction
  retouch map --teach --kind promp            the same with the thesis' own model
  retouch map --database model.sqlite --before 3 --samples 400
                                              a model of yours, without its last 3 updates and with them
"""

_WIDEST_M = 0.5
"""Beyond it no scene has a start that the arm can take."""


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
    model.add_argument("--teach", action="store_true", help="let the scripted operator correct it once first")
    where = parser.add_argument_group("the conditions")
    where.add_argument(
        "--scene", metavar="S", help="dishwasher, table or post (default: the database's, or dishwasher)"
    )
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
    draw_map(Request.from_arguments(arguments))
    return 0


@dataclass(frozen=True)
class Request:
    """What to map.

    Attributes:
        scene: by name; the database's, where there is one, by default.
        variant: of the scene; the changed one by default.
        kind: of the model, "adaptive" or "promp".
        database: that the model was taught into; the scene's first demonstrations by default.
        before: newest updates that the earlier stage lacks; one, where there is one, by default.
        teach: let the scripted operator correct the first demonstrations' model once.
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
    scene = _with_an_object(find_scene(request.scene or (stored[-1].binding.scene if stored else _SCENE)))
    variant = request.variant or scene.variants[-1]
    scene.check(variant)
    console = Terminal(stderr=True, highlight=False)
    if not stored:
        stored = _first(request, scene, variant, console)
    corrections, models = _stages(request, stored)
    places = _places(request, scene)
    jobs = request.jobs or os.cpu_count() or 1
    with _bar(console, len(places)) as advance:
        tried = conditions(Tried(scene.name, variant, models, places), jobs, advance)
    found = SuccessMap(scene.name, variant, request.kind, corrections, tuple(tried))
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
    if request.before and not request.database:
        raise NothingToMap("--before takes back updates of a database: give --database FILE")
    if request.out.suffix != ".png":
        raise NothingToMap(f"--out must name a .png file, not {str(request.out)!r}")
    for path, flag in ((request.out, "--out"), (request.json, "--json")):
        if path and not path.parent.is_dir():
            raise CommandFailed(f"{flag}: the folder {path.parent} does not exist")


def _with_an_object(scene: AnyScene) -> ReachingScene:
    if not isinstance(scene, ReachingScene):
        raise NothingToMap(f"scene {scene.name} has no object to reach: map one of {', '.join(REACHING)}")
    return scene


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
    if any(len(one.demonstration.condition) != _POSITION for one in stored):
        raise NothingToMap(f"{request.database} depends on more than the object's position: that cannot be mapped")
    return stored


def _first(request: Request, scene: ReachingScene, variant: str, console: Console) -> list[StoredDemonstration]:
    """The scene's first demonstrations, and a correction where one is asked for."""
    demonstrations = first_demonstrations(scene)
    if not request.teach:
        return [
            StoredDemonstration(i, Purpose.INITIAL, binding_of(scene), one) for i, one in enumerate(demonstrations, 1)
        ]
    with console.status("the scripted operator corrects"):
        return corrected_once(scene, variant, request.kind, demonstrations, request.seed)


def _stages(request: Request, stored: list[StoredDemonstration]) -> tuple[tuple[int, ...], tuple[MovementModel, ...]]:
    """How many corrections the model has learnt at each stage, and the model."""
    updates = sum(one.purpose is Purpose.UPDATE for one in stored)
    before = min(1, updates) if request.before is None else request.before
    if before > updates:
        raise NothingToMap(f"--before {before} takes back more than the {updates} updates of {request.database}")
    taken = sorted({updates - before, updates})
    newest_last = [one for one in stored if one.purpose is Purpose.UPDATE]
    initial = [one for one in stored if one.purpose is Purpose.INITIAL]
    models = [learn_all(request.kind, [*initial, *newest_last[:n]]) for n in taken]
    if any(model is None for model in models):
        raise NothingToMap("the model knows no motion before its updates: give a smaller --before")
    return tuple(taken), tuple(model for model in models if model is not None)


def _places(request: Request, scene: ReachingScene) -> tuple[Setting, ...]:
    if request.samples is None:
        return success_map.grid(scene, request.grid, request.spread)
    return success_map.sample(scene, request.samples, request.spread, np.random.default_rng(request.seed))


def _write(path: Path, content: bytes, flag: str) -> None:
    try:
        write_whole(path, content)
    except OSError as error:
        raise CannotKeep(path.parent, error.strerror or str(error), flag) from None


class _Rate(TextColumn):
    """Conditions a second."""

    def __init__(self) -> None:
        super().__init__("")

    def render(self, task: Task) -> Text:
        """See the base."""
        return Text(f"{task.speed:.1f} /s" if task.speed else "")


@contextmanager
def _bar(console: Console, total: int) -> Iterator[Callable[[float], None]]:
    """A bar of conditions, with their rate and the time left."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), _Rate(), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        task = progress.add_task("conditions", total=total)
        yield lambda share: progress.update(task, completed=round(share * total))
