"""The first demonstrations of a scene: taught by the scripted operator in the simulator, once, and kept.

The simulator is deterministic, so what is kept is what would be taught anew; it lies under a key of the code that
teaches, in the same format as a model's own database.
"""

from __future__ import annotations

import hashlib
import logging
import tempfile
from pathlib import Path

import sim
from lfd.motion.demonstration import Demonstration
from lfd.store.database import Binding, DemonstrationStore, Kind
from services import offline, robot
from sim.robots.description import default_cache
from sim.tasks import AnyScene

log = logging.getLogger(__name__)


def first_demonstrations(scene: AnyScene, cache: Path | None = None) -> list[Demonstration]:
    """The demonstrations that a scene's model starts from, one a training position, in the scene's first variant.

    Args:
        scene: what to teach.
        cache: folder to keep them in; the user's cache folder by default.

    Raises:
        CommandFailed: no motion to some place succeeded.
        StorageError: the cache cannot be written.
    """
    folder = cache or default_cache()
    kept = folder / f"lessons-{scene.name}-{_key()}.sqlite"
    if kept.exists():
        return _read(kept)
    log.info("teaching the first demonstrations of %s in the simulator (once)", scene.name)
    # Imported here: who finds them kept needs no simulator.
    from services.offline.lessons import lesson  # noqa: PLC0415

    taught = lesson(scene)
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder) as scratch:
        part = Path(scratch) / kept.name
        with DemonstrationStore(part) as store:
            for demonstration in taught:
                store.add(demonstration, Kind.INITIAL, Binding(scene.name, scene.robot.kind))
        part.replace(kept)
    return taught


def _read(path: Path) -> list[Demonstration]:
    with DemonstrationStore(path) as store:
        return [stored.demonstration for stored in store.active()]


def _key() -> str:
    """Of everything that decides what is taught: the world, the arm, and the teaching itself."""
    digest = hashlib.sha256()
    for package in (sim, robot, offline):
        for path in sorted(Path(package.__path__[0]).rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]
