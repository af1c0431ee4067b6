"""A model in one file: named arrays and their parameters as text, nothing that could be executed.

The durable record of what was taught is `lfd.store.database`, from which a model can always be built again. This file
is for taking one finished model elsewhere.
"""

import json
import os
import tempfile
import zipfile
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from lfd.arrays import Array, frozen
from lfd.exceptions import LfdError, StorageError
from lfd.models.adaptive.adaptation import AdaptiveOptions, AdaptiveProMP
from lfd.models.adaptive.correction import CorrectionOptions
from lfd.models.adaptive.regression import RegressionOptions
from lfd.models.adaptive.spread import SpreadPrior
from lfd.models.basis import GaussianBasis
from lfd.models.encoding import Encoding
from lfd.models.gaussian import JointGaussian
from lfd.models.promp import ConditionedProMP, PrompOptions
from lfd.motion.alignment import Selection

FORMAT = "retouch-model/1"

_HEADER = "header"


def save(model: AdaptiveProMP | ConditionedProMP, path: Path) -> None:
    """Write a model; the file is there whole or not at all.

    Args:
        model: To write.
        path: The file, usually `NAME.npz`; its folder exists.

    Raises:
        StorageError: It cannot be written.
    """
    header: dict[str, Any] = {"format": FORMAT, "options": asdict(model.options)}
    arrays: dict[str, Array] = {"rotation": model.encoding.rotation}
    match model:
        case AdaptiveProMP():
            header |= {"kind": "adaptive", "extent": model.corrections.regression.extent}
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
    except OSError as error:
        raise StorageError(path, f"cannot be written ({error.strerror})", "check folder, rights and space") from error


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
        if header["format"] != FORMAT:
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
    return {
        "conditions": regression.conditions,
        "vectors": regression.vectors,
        "corrected_conditions": corrections.conditions,
        "corrected_vectors": corrections.vectors,
    }


def _adaptive(header: dict[str, Any], arrays: dict[str, Array]) -> AdaptiveProMP:
    values = header["options"]
    options = AdaptiveOptions(
        **values
        | {
            "basis": GaussianBasis(**values["basis"]),
            "regression": RegressionOptions(**values["regression"]),
            "correction": CorrectionOptions(**values["correction"]),
            "prior": SpreadPrior(**values["prior"]),
        }
    )
    encoding = Encoding(options.basis, options.samples, arrays["rotation"], anchored=True)
    model = AdaptiveProMP.of_vectors(encoding, arrays["conditions"], arrays["vectors"], header["extent"], options)
    for s, x in zip(arrays["corrected_conditions"], arrays["corrected_vectors"], strict=True):
        model = model.corrected(s, x)
    return model


def _promp(header: dict[str, Any], arrays: dict[str, Array]) -> ConditionedProMP:
    values = header["options"]
    parsed = {"basis": GaussianBasis(**values["basis"]), "selection": Selection(values["selection"])}
    options = PrompOptions(**values | parsed)
    encoding = Encoding(options.basis, options.samples, arrays["rotation"], anchored=False)
    return ConditionedProMP(encoding, JointGaussian(arrays["mean"], arrays["scatter"], header["count"]), options)
