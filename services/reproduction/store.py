"""What has been found already, kept in a folder: a JSON file for each run of an analysis, and the pictures of one.

A result is good for as long as nothing that it came from has changed: the code is its key.
"""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import NamedTuple

import msgspec
import numpy as np

import lfd
import services
import sim
from services.process.files import write_whole
from services.reproduction.analysis import Figure, Finding
from services.reproduction.exceptions import CannotKeep

_SVG_BEGINS = b"<?xml"


class Done(msgspec.Struct, frozen=True, tag="done"):
    """The run came to its end.

    Attributes:
        finding: what it found.
        seconds: of a processor that it took; by the clock it is longer where others want the same processor [s].
    """

    finding: Finding
    seconds: float


class Failed(msgspec.Struct, frozen=True, tag="failed"):
    """It did not.

    Attributes:
        reason: in one line.
    """

    reason: str


Record = Done | Failed
"""Of one run of an analysis."""


class Run(NamedTuple):
    """Which run of which analysis; a person's, where one takes part.

    Attributes:
        name: of the analysis.
        seed: of the run.
        illustrated: with figures.
    """

    name: str
    seed: int
    illustrated: bool


class _Kept(msgspec.Struct, frozen=True):
    key: str
    illustrated: bool
    record: Record


def code_key() -> str:
    """Of all code that a result can depend on."""
    digest = hashlib.sha256()
    for package in (lfd, sim, services):
        for path in sorted(Path(package.__path__[0]).rglob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


class Store:
    """The results in a folder.

    Args:
        folder: made where it does not exist.
        key: of the results that are good; others are as if they were not there.

    Raises:
        CannotKeep: the folder cannot be written.
    """

    def __init__(self, folder: Path, key: str) -> None:
        self.folder = folder
        self.key = key
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise CannotKeep(folder, error.strerror or str(error)) from None

    def read(self, run: Run) -> Record | None:
        """The record of a run, where there is one that is still good; with the figures, where it has to have them."""
        try:
            kept = msgspec.json.decode(self._file(run).read_bytes(), type=_Kept)
            if kept.key != self.key or (run.illustrated and not kept.illustrated):
                return None
            if isinstance(kept.record, Failed):
                return kept.record
            figures = tuple(self._with_image(run, figure) for figure in kept.record.finding.figures)
        except (OSError, ValueError):  # no UTF-8 among them
            return None
        finding = msgspec.structs.replace(kept.record.finding, figures=figures)
        return msgspec.structs.replace(kept.record, finding=finding)

    def write(self, run: Run, record: Record) -> None:
        """Keep a record, in place of an earlier one.

        Raises:
            CannotKeep: the folder cannot be written.
        """
        try:
            if isinstance(record, Done):
                record = msgspec.structs.replace(record, finding=self._without_images(run, record.finding))
            encoded = msgspec.json.encode(_Kept(self.key, run.illustrated, record), enc_hook=_plain)
            write_whole(self._file(run), msgspec.json.format(encoded) + b"\n")
        except OSError as error:
            raise CannotKeep(self.folder, error.strerror or str(error)) from None

    def _file(self, run: Run) -> Path:
        return self.folder / f"{run.name}-{run.seed}.json"

    def _image(self, run: Run, figure: Figure, suffix: str) -> Path:
        return self.folder / f"{run.name}-{run.seed}-{figure.name}.{suffix}"

    def _without_images(self, run: Run, finding: Finding) -> Finding:
        for figure in finding.figures:
            suffix, other = ("svg", "png") if is_svg(figure.image) else ("png", "svg")
            write_whole(self._image(run, figure, suffix), figure.image)
            self._image(run, figure, other).unlink(missing_ok=True)
        bare = tuple(msgspec.structs.replace(figure, image=b"") for figure in finding.figures)
        return msgspec.structs.replace(finding, figures=bare)

    def _with_image(self, run: Run, figure: Figure) -> Figure:
        svg = self._image(run, figure, "svg")
        path = svg if svg.exists() else self._image(run, figure, "png")
        return msgspec.structs.replace(figure, image=path.read_bytes())


def _plain(value: object) -> object:
    """NumPy's numbers are numbers, which msgspec does not know."""
    if isinstance(value, np.generic):
        return value.item()
    raise NotImplementedError


def is_svg(image: bytes) -> bool:
    """Whether an image is an SVG, otherwise it is a PNG."""
    return image.startswith(_SVG_BEGINS)
