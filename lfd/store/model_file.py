"""A model in one file: named arrays and their parameters as text, nothing that could be executed.

The durable record of what was taught is `lfd.store.database`, from which a model can always be built again. This file
is for taking one finished model elsewhere.
"""

import json
import math
import os
import tempfile
import zipfile
from collections.abc import Sequence
from dataclasses import asdict, is_dataclass, replace
from pathlib import Path
from typing import Any, TypeVar, get_type_hints

import numpy as np

from lfd.arrays import Array, frozen
from lfd.exceptions import LfdError, StorageError
from lfd.models.adaptive.adaptation import AdaptiveOptions, AdaptiveProMP
from lfd.models.adaptive.correction import Correction
from lfd.models.adaptive.kinds import PHASES
from lfd.models.adaptive.regression import Regression
from lfd.models.adaptive.scale import ConditionScale
from lfd.models.anchor import Anchor
from lfd.models.encoding import Encoding
from lfd.models.gaussian import JointGaussian
from lfd.models.promp import ConditionedProMP, PrompOptions
from lfd.motion.alignment import Selection

FORMAT = "retouch-model/5"
READ = (FORMAT, "retouch-model/4")
"""4 knew no gripper."""

_HEADER = "header"

_Options = TypeVar("_Options")


def save(model: AdaptiveProMP | ConditionedProMP, path: Path) -> None:
    """Write a model; the file is there whole or not at all, and outlives a power cut once this has returned.

    Args:
        model: To write.
        path: The file, usually `NAME.npz`; its folder exists.

    Raises:
        StorageError: It cannot be written.
    """
    header: dict[str, Any] = {"format": FORMAT, "options": asdict(model.options)}
    arrays: dict[str, Array] = {"rotation": model.encoding.rotation}
    if model.encoding.shown is not None:
        arrays["shown"] = np.array(model.encoding.shown)
    match model:
        case AdaptiveProMP():
            header |= {"kind": "adaptive", "extent": model.corrections.extent}
            arrays |= _taught(model)
        case ConditionedProMP():
            header |= {"kind": "promp", "count": model.joint.count}
            arrays |= {"mean": model.joint.mean, "scatter": model.joint.scatter}
    content: dict[str, Any] = {_HEADER: np.frombuffer(json.dumps(header).encode(), dtype=np.uint8), **arrays}
    try:
        handle, part = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}-")
        try:
            with os.fdopen(handle, "wb") as file:
                np.savez_compressed(file, allow_pickle=False, **content)
                file.flush()
                os.fsync(file.fileno())
            Path(part).replace(path)
        finally:
            Path(part).unlink(missing_ok=True)
        _settle_names(path.parent)
    except OSError as error:
        raise StorageError(path, f"cannot be written ({error.strerror})", "check folder, rights and space") from error


def _settle_names(folder: Path) -> None:
    """Bring to the disk what the files of a folder are called: of a new file that is not yet so with its content."""
    opened = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)


def load(path: Path) -> AdaptiveProMP | ConditionedProMP:
    """Read a model that `save` wrote; it predicts and learns as the one that was saved.

    Args:
        path: The file.

    Raises:
        StorageError: There is no such file, or it is no model.
    """
    try:
        with path.open("rb") as stream, np.load(stream, allow_pickle=False) as file:
            arrays = {name: frozen(file[name]) for name in file.files if name != _HEADER}
            header = json.loads(file[_HEADER].tobytes())
        if header["format"] not in READ:
            raise StorageError(path, f"its format is {header['format']!r}, not {FORMAT!r}", "update Retouch")
        return _adaptive(header, arrays) if header["kind"] == "adaptive" else _promp(header, arrays)
    except OSError as error:
        raise StorageError(path, f"cannot be read ({error.strerror or error})", "check the file's name") from error
    except (LfdError, ValueError, KeyError, TypeError, zipfile.BadZipFile, EOFError) as error:
        if isinstance(error, StorageError):
            raise
        raise StorageError(path, "this is not a model, or it is damaged", "save it again") from error


def _taught(model: AdaptiveProMP) -> dict[str, Array]:
    regression, corrections = model.corrections.regression, model.corrections
    anchor = model.encoding.anchor or Anchor.straight()
    scale, aside = regression.scale, [correction for _, correction in corrections.aside]
    return {
        "home": anchor.home,
        "strays": anchor.strays,
        "centre": scale.centre,
        "unit": scale.unit,
        "axes": scale.axes.astype(np.float64),
        "conditions": regression.conditions,
        "vectors": regression.vectors,
        **_listed("held", corrections.held, regression),
        **_listed("aside", aside, regression),
        "aside_places": np.array([index for index, _ in corrections.aside], dtype=np.float64),
    }


def _listed(name: str, corrections: Sequence[Correction], regression: Regression) -> dict[str, Array]:
    c, D = regression.conditions.shape[1], regression.vectors.shape[1]
    unknown = np.full((PHASES, 3), np.nan)
    return {
        f"{name}_conditions": np.array([correction.s for correction in corrections]).reshape(-1, c),
        f"{name}_vectors": np.array([correction.x for correction in corrections]).reshape(-1, D),
        f"{name}_led": np.array([unknown if x.led is None else x.led for x in corrections]).reshape(-1, PHASES, 3),
        f"{name}_times": np.array([np.nan if x.at_s is None else x.at_s for x in corrections], dtype=np.float64),
    }


def _corrections(name: str, arrays: dict[str, Array]) -> list[Correction]:
    columns = (arrays[f"{name}_{of}"] for of in ("conditions", "vectors", "times", "led"))
    return [
        Correction(s, x, None if math.isnan(at_s) else float(at_s), None if np.isnan(led).any() else led)
        for s, x, at_s, led in zip(*columns, strict=True)
    ]


def _adaptive(header: dict[str, Any], arrays: dict[str, Array]) -> AdaptiveProMP:
    options = _options(AdaptiveOptions, header["options"])
    anchor = Anchor(arrays["home"], arrays["strays"])
    encoding = Encoding(options.basis, options.samples, arrays["rotation"], anchor, _shown(arrays))
    axes = arrays["axes"].astype(np.intp)
    scale = ConditionScale(arrays["centre"], arrays["unit"], axes, np.ones(len(axes)))
    model = AdaptiveProMP.of_vectors(
        encoding, scale, arrays["conditions"], arrays["vectors"], extent=header["extent"], options=options
    )
    places = arrays["aside_places"].astype(int).tolist()
    aside = tuple(zip(places, _corrections("aside", arrays), strict=True))
    return replace(model, corrections=replace(model.corrections, held=tuple(_corrections("held", arrays)), aside=aside))


def _promp(header: dict[str, Any], arrays: dict[str, Array]) -> ConditionedProMP:
    values = header["options"]
    options = _options(PrompOptions, values | {"selection": Selection(values["selection"])})
    anchor = Anchor.straight() if options.anchored else None
    encoding = Encoding(options.basis, options.samples, arrays["rotation"], anchor, _shown(arrays))
    return ConditionedProMP(encoding, JointGaussian(arrays["mean"], arrays["scatter"], header["count"]), options)


def _shown(arrays: dict[str, Array]) -> tuple[float, float] | None:
    if "shown" not in arrays:
        return None
    least, greatest = arrays["shown"].tolist()
    return least, greatest


def _options(kind: type[_Options], values: dict[str, Any]) -> _Options:
    """Options of options, from what `asdict` and JSON made of them; one that came later has its default.

    Raises:
        ValueError: It has one that there is not.
    """
    types = get_type_hints(kind)
    if not values.keys() <= types.keys():
        raise ValueError(kind.__name__)
    parsed = {
        name: _options(types[name], value)
        if is_dataclass(types[name])
        else tuple(value)
        if isinstance(value, list)
        else value
        for name, value in values.items()
    }
    return kind(**parsed)
