"""What has been found already, kept in a folder: a JSON file and its pictures for each analysis.

A result is good for as long as nothing that it came from has changed: the code and the seed are its key.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

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
    """The analysis ran to its end.

    Attributes:
        finding: what it found.
        seconds: that it took.
    """

    finding: Finding
    seconds: float


class Failed(msgspec.Struct, frozen=True, tag="failed"):
    """It did not.

    Attributes:
        reason: in one line.
    """

    reason: str


Outcome = Done | Failed


class _Kept(msgspec.Struct, frozen=True):
    key: str
    outcome: Outcome


def code_key(seed: int) -> str:
    """Of all code that a result can depend on, and the seed."""
    digest = hashlib.sha256(str(seed).encode())
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

    def read(self, name: str) -> Outcome | None:
        """The outcome of an analysis, where there is one that is still good."""
        try:
            kept = msgspec.json.decode(self._record(name).read_bytes(), type=_Kept)
            if kept.key != self.key:
                return None
            if isinstance(kept.outcome, Failed):
                return kept.outcome
            figures = tuple(self._with_image(name, figure) for figure in kept.outcome.finding.figures)
        except (OSError, msgspec.MsgspecError):
            return None
        finding = msgspec.structs.replace(kept.outcome.finding, figures=figures)
        return msgspec.structs.replace(kept.outcome, finding=finding)

    def write(self, name: str, outcome: Outcome) -> None:
        """Keep an outcome, in place of an earlier one.

        Raises:
            CannotKeep: the folder cannot be written.
        """
        try:
            if isinstance(outcome, Done):
                outcome = msgspec.structs.replace(outcome, finding=self._without_images(name, outcome.finding))
            encoded = msgspec.json.encode(_Kept(self.key, outcome), enc_hook=_plain)
            write_whole(self._record(name), msgspec.json.format(encoded) + b"\n")
        except OSError as error:
            raise CannotKeep(self.folder, error.strerror or str(error)) from None

    def _record(self, name: str) -> Path:
        return self.folder / f"{name}.json"

    def _image(self, name: str, figure: Figure, suffix: str) -> Path:
        return self.folder / f"{name}-{figure.name}.{suffix}"

    def _without_images(self, name: str, finding: Finding) -> Finding:
        for figure in finding.figures:
            suffix, other = ("svg", "png") if is_svg(figure.image) else ("png", "svg")
            write_whole(self._image(name, figure, suffix), figure.image)
            self._image(name, figure, other).unlink(missing_ok=True)
        bare = tuple(msgspec.structs.replace(figure, image=b"") for figure in finding.figures)
        return msgspec.structs.replace(finding, figures=bare)

    def _with_image(self, name: str, figure: Figure) -> Figure:
        svg = self._image(name, figure, "svg")
        path = svg if svg.exists() else self._image(name, figure, "png")
        return msgspec.structs.replace(figure, image=path.read_bytes())


def _plain(value: object) -> object:
    """NumPy's numbers are numbers, which msgspec does not know."""
    if isinstance(value, np.generic):
        return value.item()
    raise NotImplementedError


def is_svg(image: bytes) -> bool:
    """Whether an image is an SVG, otherwise it is a PNG."""
    return image.startswith(_SVG_BEGINS)
