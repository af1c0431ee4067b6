"""The first demonstrations of a scene: taught by the scripted operator in the simulator, once, and kept.

The simulator is deterministic, so what is kept is what would be taught anew; it lies under a key of the code that
teaches, in the same format as a model's own database.
"""

from __future__ import annotations

import errno
import hashlib
import logging
from functools import cached_property
from pathlib import Path

import sim
from lfd.exceptions import StorageUnavailable
from lfd.motion.demonstration import Demonstration
from lfd.store.database import DemonstrationStore
from lfd.store.schema import SCHEMA_VERSION
from lfd.store.stored import Binding, Purpose
from services import offline, robot
from sim.cache import kept
from sim.robots.description import source_of
from sim.tasks import AnyScene
from sim.tasks.reaching import ReachingScene

log = logging.getLogger(__name__)


def first_demonstrations(scene: AnyScene, cache: Path | None = None) -> list[Demonstration]:
    """The demonstrations that a scene's model starts from, one a training position, in the scene's first variant.

    Args:
        scene: what to teach.
        cache: folder to keep them in; see `sim.cache`.

    Raises:
        CommandFailed: no motion to some place succeeded.
        CacheUnusable: there is no place to keep them.
        StorageError: what is kept cannot be read.
    """
    path = kept(f"first-{scene.name}-{_key(scene)}.sqlite", _Teaching(scene), cache)
    with DemonstrationStore(path) as store:
        return [stored.demonstration for stored in store.active()]


class _Teaching:
    """Teaches once, and writes wherever there is a place."""

    def __init__(self, scene: AnyScene) -> None:
        self._scene = scene

    def __call__(self, part: Path, target: Path) -> None:
        del target
        binding = Binding(self._scene.name, self._scene.robot.kind)
        try:
            with DemonstrationStore(part) as store:
                for demonstration in self._taught:
                    store.add(demonstration, Purpose.INITIAL, binding)
        except StorageUnavailable as error:
            raise OSError(errno.EIO, error.reason, str(part.parent)) from None

    @cached_property
    def _taught(self) -> list[Demonstration]:
        log.info("teaching the first demonstrations of %s in the simulator (once)", self._scene.name)
        # Imported here: who finds them kept needs no simulator.
        from services.offline.demonstrations import demonstrations  # noqa: PLC0415

        return demonstrations(self._scene)


def _key(scene: AnyScene) -> str:
    """Of everything that decides what is taught, the world, the robot and the teaching itself, and how it is kept.

    An older version beside this one could not read what this one has kept.
    """
    digest = hashlib.sha256(SCHEMA_VERSION.to_bytes(2))
    if isinstance(scene, ReachingScene):
        digest.update(scene.told)
        if not scene.manipulator.source.package:
            digest.update(source_of(scene.manipulator).read_bytes())
    for package in (sim, robot, offline):
        for path in sorted(Path(package.__path__[0]).rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]
